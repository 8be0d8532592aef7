#include "search/mate.h"

namespace search::mate {

namespace {

constexpr std::uint64_t nodes_between_looks = 256;

}  // namespace

void Watch::count() {
    ++nodes_;
    if (over_) return;
    over_ = out_of_nodes();
    if (nodes_ % nodes_between_looks == 0) over_ |= stopped() || out_of_time();
}

bool Watch::out_of_nodes() const {
    if (unlimited_) return false;
    return (part_ && nodes_ > *part_) || (limits_.nodes && nodes_ > *limits_.nodes);
}

bool Watch::out_of_time() const {
    return !unlimited_ && limits_.time && Clock::now() - start_ >= *limits_.time;
}

void Watch::end_part_at(std::uint64_t nodes) {
    part_ = limits_.nodes ? std::min(nodes, *limits_.nodes / 2) : nodes;
}

void Watch::begin_last_part() {
    part_.reset();
    over_ = out_of_nodes() || out_of_time() || stopped();
}

void Watch::unlimit() { unlimited_ = true; }

}  // namespace search::mate
