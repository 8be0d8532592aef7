#include "selfplay/records/npz.h"

#include <fmt/format.h>
#include <minizip/zip.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <utility>

#include "engine/base/error.h"

namespace selfplay::records {

struct NpzWriter::Zip {
    zipFile file = nullptr;
    bool in_array = false;
};

std::string npy_header(const std::vector<std::size_t>& shape) {
    static_assert(std::endian::native == std::endian::little);
    std::string sides;
    for (const auto side : shape) sides += fmt::format("{},", side);
    auto words = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", sides);
    constexpr std::size_t before = 10, alignment = 64;
    while ((before + words.size() + 1) % alignment != 0) words += ' ';
    words += '\n';
    const auto length = words.size();
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(length & 0xff);
    header += static_cast<char>(length >> 8);
    return header + words;
}

NpzWriter::NpzWriter(std::filesystem::path path)
    : path_(std::move(path)), unfinished_(path_), zip_(std::make_unique<Zip>()) {
    unfinished_ += ".part";
    zip_->file = zipOpen64(unfinished_.c_str(), APPEND_STATUS_CREATE);
    if (!zip_->file) fail("cannot be written");
}

NpzWriter::~NpzWriter() {
    if (!zip_->file) return;
    if (zip_->in_array) zipCloseFileInZip(zip_->file);
    zipClose(zip_->file, nullptr);
    std::error_code ignored;
    std::filesystem::remove(unfinished_, ignored);
}

void NpzWriter::fail(std::string_view what) const { engine::fail("{}: {}", path_.string(), what); }

void NpzWriter::begin(const std::string& name, const std::vector<std::size_t>& shape) {
    end_array();
    constexpr int fast = 1;  // planes are mostly zeros: a better search gains little
    const zip_fileinfo no_date{};
    const auto status = zipOpenNewFileInZip64(zip_->file, (name + ".npy").c_str(), &no_date,
                                              nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, fast, 1);
    if (status != ZIP_OK) fail("cannot hold another array");
    zip_->in_array = true;
    const auto header = npy_header(shape);
    if (zipWriteInFileInZip(zip_->file, header.data(), static_cast<unsigned>(header.size())) !=
        ZIP_OK)
        fail("cannot be written");
    wanted_ = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

void NpzWriter::write(std::span<const float> numbers) {
    assert(numbers.size() <= wanted_);
    wanted_ -= numbers.size();
    constexpr std::size_t most = std::size_t{1} << 20;
    while (!numbers.empty()) {
        const auto part = numbers.first(std::min(numbers.size(), most));
        if (zipWriteInFileInZip(zip_->file, part.data(),
                                static_cast<unsigned>(part.size_bytes())) != ZIP_OK)
            fail("cannot be written");
        numbers = numbers.subspan(part.size());
    }
}

void NpzWriter::end_array() {
    assert(wanted_ == 0);
    if (!std::exchange(zip_->in_array, false)) return;
    if (zipCloseFileInZip(zip_->file) != ZIP_OK) fail("cannot be written");
}

void NpzWriter::close() {
    end_array();
    if (zipClose(std::exchange(zip_->file, nullptr), nullptr) != ZIP_OK) fail("cannot be written");
    std::error_code error;
    std::filesystem::rename(unfinished_, path_, error);
    if (error) fail(error.message());
}

}  // namespace selfplay::records
