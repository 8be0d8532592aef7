// Our own file format, and what every reader does with damaged and hostile bytes.
#include "engine/base/files.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "naive.h"
#include "nn/gzip.h"
#include "nn/load.h"
#include "nn/safetensors.h"

namespace nn {
namespace {

std::string message_of(const std::string& bytes) {
    try {
        graph_from_bytes(bytes);
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "";
}

Graph network() {
    engine::Random random(3);
    auto graph = naive::every_operation(random, 5);
    graph.facts.game = "go";
    graph.facts.encoding = "alphazero";
    graph.facts.name = "a \"quoted\" name";
    graph.facts.licence = "MIT";
    graph.facts.blocks = 2;
    graph.facts.channels = 5;
    graph.facts.steps = 123456789012;
    return graph;
}

std::uint64_t header_size(const std::string& file) {
    std::uint64_t size = 0;
    std::memcpy(&size, file.data(), 8);
    return size;
}

// The file with `change` done to its header, and the checksum left alone.
template <class Change>
std::string with_header(const std::string& file, Change change) {
    const auto size = header_size(file);
    auto header = nlohmann::json::parse(file.substr(8, size));
    change(header);
    const auto text = header.dump();
    const std::uint64_t length = text.size();
    return std::string(reinterpret_cast<const char*>(&length), 8) + text + file.substr(8 + size);
}

std::string gzip(const std::string& plain) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, 31, 9, Z_DEFAULT_STRATEGY);
    std::string out(deflateBound(&stream, plain.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    stream.avail_in = static_cast<uInt>(plain.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

TEST(Safetensors, KeepEverything) {
    const auto graph = network();
    EXPECT_EQ(graph_from_bytes(to_safetensors(graph)), graph);
    EXPECT_EQ(graph_from_bytes(gzip(to_safetensors(graph))), graph);
}

TEST(Safetensors, KeepTheLayoutThatOthersRead) {
    const auto file = to_safetensors(network());
    const auto size = header_size(file);
    EXPECT_EQ((8 + size) % 8, 0u);
    const auto header = nlohmann::json::parse(file.substr(8, size));
    std::size_t end = 0;
    for (const auto& [name, entry] : header.items()) {
        if (name == "__metadata__") {
            for (const auto& [key, value] : entry.items()) EXPECT_TRUE(value.is_string()) << key;
            continue;
        }
        std::size_t count = 4;
        for (const auto& side : entry["shape"]) count *= side.get<std::size_t>();
        const auto from = entry["data_offsets"][0].get<std::size_t>();
        const auto to = entry["data_offsets"][1].get<std::size_t>();
        EXPECT_EQ(to - from, count) << name;
        end = std::max(end, to);
    }
    EXPECT_EQ(8 + size + end, file.size());
    const auto& kernel = header["first.weight"];
    EXPECT_EQ(kernel["shape"], (std::vector<int>{5, 3, 5, 5}));
    EXPECT_EQ(kernel["dtype"], "F32");
}

TEST(Safetensors, SaveAndLoadByPath) {
    const auto path = std::filesystem::path(testing::TempDir()) / "network.safetensors";
    save(network(), path);
    EXPECT_EQ(load(path), network());
    engine::write_file(path, "nothing of the kind");
    try {
        load(path);
        FAIL();
    } catch (const engine::Error& error) {
        EXPECT_EQ(std::string(error.what()).find(path.string()), 0u) << error.what();
    }
    std::filesystem::remove(path);
}

TEST(Safetensors, RefuseEveryCut) {
    const auto file = to_safetensors(network());
    for (std::size_t size = 0; size < file.size(); size += 1 + size / 16)
        EXPECT_NE(message_of(file.substr(0, size)), "") << size;
    EXPECT_NE(message_of(file.substr(0, file.size() - 1)), "");
    EXPECT_NE(message_of(file + '\0'), "");
}

TEST(Safetensors, RefuseEveryChangedByteOfTheWeights) {
    const auto file = to_safetensors(network());
    const auto start = 8 + header_size(file);
    for (auto at = start; at < file.size(); at += 97) {
        auto changed = file;
        changed[at] = static_cast<char>(changed[at] ^ 1);
        EXPECT_EQ(message_of(changed).find("expected checksum crc32:"), 0u);
    }
}

TEST(Safetensors, RefuseLengthsThatOverflow) {
    auto file = to_safetensors(network());
    const auto original = file;
    for (const std::uint64_t size : {~0ull, ~0ull - 7, 1ull << 63, 1ull << 26, 1ull << 40}) {
        std::memcpy(file.data(), &size, 8);
        EXPECT_NE(message_of(file), "") << size;
    }
    const auto huge = [&](auto&& change) { return message_of(with_header(original, change)); };
    using Json = nlohmann::json;
    EXPECT_NE(huge([](Json& h) {
                  h["first.weight"]["shape"] = {1 << 30, 1 << 30, 1 << 30, 16};
              }),
              "");
    EXPECT_NE(huge([](Json& h) { h["first.weight"]["shape"] = {-5, -3, 5, 5}; }), "");
    EXPECT_NE(huge([](Json& h) { h["first.weight"]["shape"] = 1e300; }), "");
    EXPECT_NE(huge([](Json& h) { h["first.weight"]["data_offsets"] = {1ull << 62, ~0ull}; }), "");
    EXPECT_NE(huge([](Json& h) { h["first.weight"]["data_offsets"] = {400, 0}; }), "");
    EXPECT_NE(huge([](Json& h) { h["first.weight"]["dtype"] = "F16"; }), "");
    EXPECT_NE(huge([](Json& h) { h.erase("first.weight"); }), "");
    EXPECT_NE(huge([](Json& h) { h.erase("__metadata__"); }), "");
    EXPECT_NE(huge([](Json& h) { h["__metadata__"]["sanban"] = 7; }), "");
    EXPECT_NE(huge([](Json& h) { h = Json::array({1, 2}); }), "");
}

TEST(Safetensors, RefuseWeightsThatAreNoNumbers) {
    auto graph = network();
    graph.nodes[2].weights[0].values[7] = std::nanf("");
    EXPECT_EQ(message_of(to_safetensors(graph)), "\"first\": expected finite weights, found nan");
}

TEST(Gzip, RefusesBombsAndCuts) {
    EXPECT_EQ(gunzip(gzip("abc")), "abc");
    const auto bomb = gzip(std::string(100 << 20, '\0'));
    EXPECT_LT(bomb.size(), 200000u);
    EXPECT_NE(message_of(bomb).find("which no weight file of"), std::string::npos);
    const auto whole = gzip(to_safetensors(network()));
    for (std::size_t size = 2; size < whole.size(); size += 211)
        EXPECT_THROW(gunzip(whole.substr(0, size)), engine::Error) << size;
}

TEST(Load, RefusesOtherFiles) {
    EXPECT_EQ(message_of(""), "expected a network, found nothing");
    EXPECT_NE(message_of("PK\x03\x04 some archive"), "");
    EXPECT_NE(message_of(std::string(100000, '{')), "");
    EXPECT_NE(message_of("(;GM[1]FF[4])"), "");
    EXPECT_THROW(load(testing::TempDir()), engine::Error);
    EXPECT_THROW(load("no such file"), engine::Error);
}

// A header of a hundred thousand brackets must not take the stack.
TEST(Load, SurvivesDeepNesting) {
    std::string text = "{\"a\":" + std::string(100000, '[');
    const std::uint64_t size = text.size();
    EXPECT_NE(message_of(std::string(reinterpret_cast<const char*>(&size), 8) + text), "");
}

}  // namespace
}  // namespace nn
