#include "nn/load.h"

#include <fmt/format.h>
#include <zlib.h>

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "nn/gzip.h"
#include "nn/katago.h"
#include "nn/lc0.h"
#include "nn/leela_zero.h"
#include "nn/safetensors.h"

namespace nn {

namespace {

std::string key_of(std::string_view bytes) {
    const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
    return fmt::format("{:08x}{:08x}{:x}", crc32_z(0, data, bytes.size()),
                       adler32_z(1, data, bytes.size()), bytes.size());
}

}  // namespace

Graph graph_from_bytes(std::string_view bytes) {
    std::string plain;
    if (is_gzip(bytes)) {
        plain = gunzip(bytes);
        bytes = plain;
    }
    if (bytes.empty()) engine::fail("expected a network, found nothing");
    if (is_safetensors(bytes)) return graph_from_safetensors(bytes);
    if (is_lc0(bytes)) return graph_from_lc0(bytes);
    if (is_leela_zero(bytes)) return graph_from_leela_zero(bytes);
    if (is_katago(bytes)) return graph_from_katago(bytes);
    engine::fail("expected a network of sanban, KataGo, lc0 or Leela Zero, found none of them");
}

Graph load(const std::filesystem::path& path) { return load_contents(path).graph; }

Contents contents_from_bytes(std::string_view bytes) {
    Contents contents{graph_from_bytes(bytes), {}, key_of(bytes)};
    if (is_safetensors(bytes))
        contents.calibration = calibration_from_safetensors(bytes, contents.graph);
    return contents;
}

Contents load_contents(const std::filesystem::path& path) {
    const auto bytes = engine::read_file(path);
    try {
        return contents_from_bytes(bytes);
    } catch (const engine::Error& error) {
        engine::fail("{}: {}", path.string(), error.what());
    }
}

void save(const Graph& graph, const std::filesystem::path& path, const Calibration& calibration) {
    engine::write_file(path, to_safetensors(graph, {}, calibration));
}

}  // namespace nn
