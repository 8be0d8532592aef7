// Arrays for NumPy: a .npz file, which is a zip of .npy files (NEP 1), written array after array
// without ever being whole in memory. The file appears under its name once close() has returned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace selfplay::records {

class NpzWriter {
   public:
    // Every failure here is an engine::Error that names the path.
    explicit NpzWriter(std::filesystem::path path);
    NpzWriter(const NpzWriter&) = delete;
    NpzWriter& operator=(const NpzWriter&) = delete;
    // What was not closed is removed.
    ~NpzWriter();

    // Begins an array of 32-bit floats, row-major; then as many numbers follow as it holds.
    void begin(const std::string& name, const std::vector<std::size_t>& shape);
    void write(std::span<const float> numbers);
    void close();

   private:
    struct Zip;

    void end_array();
    [[noreturn]] void fail(std::string_view what) const;

    std::filesystem::path path_, unfinished_;
    std::unique_ptr<Zip> zip_;
    std::size_t wanted_ = 0;  // numbers of the array that are still to come
};

// What stands before the numbers of an array in a .npy file.
std::string npy_header(const std::vector<std::size_t>& shape);

}  // namespace selfplay::records
