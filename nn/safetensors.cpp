#include "nn/safetensors.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"

namespace nn {

namespace {

using engine::fail;
using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "the format is little-endian");

constexpr std::size_t most_header = std::size_t{1} << 26;
constexpr int version = 1;
constexpr std::string_view extra_prefix = "training/", calibration_prefix = "calibration/";

// Of no operation's weights.
bool is_row(const std::string& name) {
    return name.starts_with(extra_prefix) || name.starts_with(calibration_prefix);
}

// --- the header's JSON, read without trust

const Json& member(const Json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end()) fail("expected a member \"{}\"", key);
    return *found;
}

std::string text_at(const Json& object, const char* key) {
    const auto& value = member(object, key);
    if (!value.is_string()) fail("expected text under \"{}\"", key);
    return value.get<std::string>();
}

std::int64_t number_of(const Json& value, const char* what, std::int64_t most) {
    const bool fits = value.is_number_integer() &&
                      (!value.is_number_unsigned() ||
                       value.get<std::uint64_t>() <= static_cast<std::uint64_t>(most));
    const auto number = fits ? value.get<std::int64_t>() : -1;
    if (number < 0 || number > most)
        fail("expected {} of 0 to {}, found {}", what, most, value.dump().substr(0, 40));
    return number;
}

int integer_of(const Json& value, const char* what) {
    return static_cast<int>(number_of(value, what, (1 << 30)));
}

std::vector<int> integers_of(const Json& value, const char* what) {
    if (!value.is_array()) fail("expected a list of {}", what);
    std::vector<int> numbers;
    for (const auto& item : value) numbers.push_back(integer_of(item, what));
    return numbers;
}

// --- tensors

struct Stored {
    std::vector<int> shape;
    std::string_view bytes;
};

std::int64_t count_of(const std::vector<int>& shape, std::int64_t most) {
    std::int64_t count = 1;
    for (const int side : shape)
        if (side == 0 || (count *= side) > most) return -1;
    return count;
}

Stored stored_tensor(const std::string& name, const Json& entry, std::string_view data) {
    if (text_at(entry, "dtype") != "F32")
        fail("tensor \"{}\": expected F32, found {}", name, text_at(entry, "dtype"));
    Stored stored{integers_of(member(entry, "shape"), "sides"), {}};
    const auto& offsets = member(entry, "data_offsets");
    if (!offsets.is_array() || offsets.size() != 2)
        fail("tensor \"{}\": expected two offsets", name);
    const auto most = static_cast<std::int64_t>(data.size());
    const auto begin = number_of(offsets[0], "an offset", most);
    const auto end = number_of(offsets[1], "an offset", most);
    const auto count = count_of(stored.shape, most);
    if (count < 0 || end - begin != 4 * count)
        fail("tensor \"{}\": expected {} bytes of data, found {}", name, 4 * count, end - begin);
    stored.bytes =
        data.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
    return stored;
}

Tensor tensor_of(const Stored& stored) {
    Tensor tensor{stored.shape, std::vector<float>(stored.bytes.size() / 4)};
    std::memcpy(tensor.values.data(), stored.bytes.data(), stored.bytes.size());
    return tensor;
}

std::string checksum_of(std::string_view graph, std::string_view data) {
    auto sum = crc32_z(0, nullptr, 0);
    for (const auto part : {graph, data})
        sum = crc32_z(sum, reinterpret_cast<const Bytef*>(part.data()), part.size());
    return fmt::format("crc32:{:08x}", sum);
}

// --- nodes

template <class Kind>
Kind kind_at(const Json& entry, const char* key, std::optional<Kind> (*from)(std::string_view)) {
    const auto name = text_at(entry, key);
    const auto kind = from(name);
    if (!kind) fail("unknown {}: {}", key, name);
    return *kind;
}

void read_extras(const Json& entry, Node& node) {
    if (entry.contains("activation"))
        node.activation = kind_at(entry, "activation", activation_from);
    if (node.operation == Operation::pool) node.pooling = kind_at(entry, "pooling", pooling_from);
    if (node.operation == Operation::gather)
        node.table = integers_of(member(entry, "table"), "indices");
    if (node.operation == Operation::input)
        node.shape = {integer_of(member(entry, "channels"), "channels"),
                      text_at(entry, "over") == "board"};
    if (node.operation == Operation::batch_norm) {
        const auto& epsilon = member(entry, "epsilon");
        if (!epsilon.is_number()) fail("expected a number under \"epsilon\"");
        node.epsilon = epsilon.get<float>();
    }
}

Node node_from(const Json& entry, const std::map<std::string, Stored>& tensors) {
    Node node{.operation = kind_at(entry, "operation", operation_from),
              .name = text_at(entry, "name")};
    node.inputs = integers_of(member(entry, "inputs"), "inputs");
    for (const auto name : weight_names(node.operation)) {
        const auto found = tensors.find(fmt::format("{}.{}", node.name, name));
        if (found == tensors.end()) break;
        node.weights.push_back(tensor_of(found->second));
    }
    read_extras(entry, node);
    return node;
}

Json to_json(const Node& node) {
    Json entry = {
        {"operation", name_of(node.operation)}, {"name", node.name}, {"inputs", node.inputs}};
    if (node.activation != Activation::identity) entry["activation"] = name_of(node.activation);
    if (node.operation == Operation::pool) entry["pooling"] = name_of(node.pooling);
    if (node.operation == Operation::gather) entry["table"] = node.table;
    if (node.operation == Operation::batch_norm) entry["epsilon"] = node.epsilon;
    if (node.operation == Operation::input) {
        entry["channels"] = node.shape.channels;
        entry["over"] = node.shape.over_board ? "board" : "nothing";
    }
    return entry;
}

Facts facts_from(const Json& entry) {
    Facts facts;
    facts.game = text_at(entry, "game");
    facts.encoding = text_at(entry, "encoding");
    facts.name = text_at(entry, "name");
    facts.source = text_at(entry, "source");
    facts.licence = text_at(entry, "licence");
    facts.board = integer_of(member(entry, "board"), "a board");
    facts.blocks = integer_of(member(entry, "blocks"), "blocks");
    facts.channels = integer_of(member(entry, "channels"), "channels");
    facts.steps = number_of(member(entry, "steps"), "steps", std::int64_t{1} << 60);
    return facts;
}

Json to_json(const Facts& facts) {
    return {{"game", facts.game},     {"encoding", facts.encoding}, {"name", facts.name},
            {"source", facts.source}, {"licence", facts.licence},   {"board", facts.board},
            {"blocks", facts.blocks}, {"channels", facts.channels}, {"steps", facts.steps}};
}

Json parse(std::string_view text, const char* what) {
    auto json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) fail("{} is no JSON", what);
    return json;
}

Graph graph_from(const Json& description, const std::map<std::string, Stored>& tensors) {
    const auto found = number_of(member(description, "version"), "a version", 1 << 20);
    if (found != version) fail("expected version {}, found {}", version, found);
    Graph graph;
    graph.facts = facts_from(member(description, "facts"));
    const auto& nodes = member(description, "nodes");
    const auto& outputs = member(description, "outputs");
    if (!nodes.is_array() || !outputs.is_array()) fail("expected lists of nodes and outputs");
    auto used = static_cast<std::size_t>(std::count_if(
        tensors.begin(), tensors.end(), [](const auto& entry) { return is_row(entry.first); }));
    for (const auto& entry : nodes) {
        graph.nodes.push_back(node_from(entry, tensors));
        used += graph.nodes.back().weights.size();
    }
    if (used != tensors.size())
        fail("expected {} tensors by the graph, found {}", used, tensors.size());
    for (const auto& output : outputs)
        graph.outputs.push_back(
            {text_at(output, "name"), integer_of(member(output, "node"), "a node")});
    return graph;
}

std::uint64_t header_size(std::string_view bytes) {
    std::uint64_t size = 0;
    if (bytes.size() >= sizeof size) std::memcpy(&size, bytes.data(), sizeof size);
    return size;
}

std::map<std::string, Stored> stored_tensors(const Json& header, std::string_view data) {
    std::map<std::string, Stored> tensors;
    std::size_t total = 0;
    for (const auto& [name, entry] : header.items()) {
        if (name == "__metadata__") continue;
        const auto& stored = tensors[name] = stored_tensor(name, entry, data);
        total += stored.bytes.size();
    }
    if (total != data.size()) fail("expected {} bytes of tensors, found {}", total, data.size());
    return tensors;
}

// A file whose header and checksum are sound.
struct File {
    std::string description;
    std::map<std::string, Stored> tensors;
};

File opened(std::string_view bytes) {
    const auto size = header_size(bytes);
    if (bytes.size() < 8 || size > most_header || size > bytes.size() - 8)
        fail("expected a header of {} bytes, found a file of {}", size, bytes.size());
    const auto data = bytes.substr(8 + size);
    const auto header = parse(bytes.substr(8, size), "the header");
    const auto& metadata = member(header, "__metadata__");
    auto description = text_at(metadata, "sanban");
    const auto sum = checksum_of(description, data);
    if (text_at(metadata, "checksum") != sum)
        fail("expected checksum {}, found {}", text_at(metadata, "checksum").substr(0, 40), sum);
    return {std::move(description), stored_tensors(header, data)};
}

// A file in the making: its tensors, and their entries in the header.
struct Members {
    Json header = Json::object();
    std::string data;

    void add(const std::string& name, const std::vector<int>& shape,
             const std::vector<float>& values) {
        const auto begin = data.size();
        data.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
        header[name] = {{"dtype", "F32"}, {"shape", shape}, {"data_offsets", {begin, data.size()}}};
    }
    void add_rows(std::string_view prefix, const Extras& rows) {
        for (const auto& [name, row] : rows)
            add(fmt::format("{}{}", prefix, name), {static_cast<int>(row.size())}, row);
    }
};

Extras rows_of(std::string_view bytes, std::string_view prefix) {
    Extras rows;
    for (const auto& [name, stored] : opened(bytes).tensors)
        if (name.starts_with(prefix)) rows[name.substr(prefix.size())] = tensor_of(stored).values;
    return rows;
}

std::string description_of(const Graph& graph) {
    Json nodes = Json::array(), outputs = Json::array();
    for (const auto& node : graph.nodes) nodes.push_back(to_json(node));
    for (const auto& output : graph.outputs)
        outputs.push_back({{"name", output.name}, {"node", output.node}});
    return Json{{"version", version},
                {"facts", to_json(graph.facts)},
                {"nodes", nodes},
                {"outputs", outputs}}
        .dump();
}

}  // namespace

bool is_safetensors(std::string_view bytes) {
    return bytes.size() > 8 && bytes[8] == '{' && header_size(bytes) <= most_header;
}

Graph graph_from_safetensors(std::string_view bytes) {
    const auto file = opened(bytes);
    auto graph = graph_from(parse(file.description, "the graph"), file.tensors);
    validate(graph);
    return graph;
}

Extras extras_from_safetensors(std::string_view bytes) { return rows_of(bytes, extra_prefix); }

Calibration calibration_from_safetensors(std::string_view bytes, const Graph& graph) {
    return calibration_from(graph, rows_of(bytes, calibration_prefix));
}

std::string to_safetensors(const Graph& graph, const Extras& extras,
                           const Calibration& calibration) {
    Members members;
    for (const auto& node : graph.nodes)
        for (std::size_t i = 0; i < node.weights.size(); ++i)
            members.add(fmt::format("{}.{}", node.name, weight_names(node.operation)[i]),
                        node.weights[i].shape, node.weights[i].values);
    members.add_rows(extra_prefix, extras);
    members.add_rows(calibration_prefix, named_maxima(graph, calibration));
    const auto description = description_of(graph);
    members.header["__metadata__"] = {{"sanban", description},
                                      {"checksum", checksum_of(description, members.data)},
                                      {"format", "pt"}};
    auto text = members.header.dump();
    text.resize((text.size() + 7) / 8 * 8, ' ');
    std::uint64_t size = text.size();
    std::string file(reinterpret_cast<const char*>(&size), sizeof size);
    return file + text + members.data;
}

}  // namespace nn
