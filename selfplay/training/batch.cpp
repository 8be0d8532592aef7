#include "selfplay/training/batch.h"

#include <algorithm>
#include <cassert>

namespace selfplay::training {

namespace {

using nn::training::Loss;

template <class Row>
void append(const Row& row, std::vector<float>& to) {
    to.insert(to.end(), row.begin(), row.end());
}

bool teaches(const std::vector<float>& policy) {
    return std::any_of(policy.begin(), policy.end(), [](float share) { return share > 0; });
}

}  // namespace

void Batch::fill(std::span<const Lesson> lessons, int board,
                 std::span<const nn::training::Term> terms) {
    assert(!lessons.empty());
    planes_.clear();
    globals_.clear();
    rows_.assign(terms.size(), {});
    for (const auto& lesson : lessons) {
        append(lesson.planes, planes_);
        append(lesson.globals, globals_);
        for (std::size_t t = 0; t < terms.size(); ++t) add(lesson, terms[t].loss, rows_[t]);
    }
    samples_ = {static_cast<int>(lessons.size()), board, {planes_}, {}};
    if (!globals_.empty()) samples_.inputs.emplace_back(globals_);
    for (auto& rows : rows_) {
        rows.starts.push_back(static_cast<int>(rows.moves.size()));
        samples_.targets.push_back({rows.numbers, rows.starts, rows.moves, true, rows.weights});
    }
}

void Batch::add(const Lesson& lesson, Loss loss, Rows& rows) {
    bool known = true;
    float weight = 1;
    switch (loss) {
        case Loss::policy:
            rows.starts.push_back(static_cast<int>(rows.moves.size()));
            rows.moves.insert(rows.moves.end(), lesson.moves.begin(), lesson.moves.end());
            append(lesson.policy, rows.numbers);
            known = teaches(lesson.policy);
            weight = lesson.policy_weight;
            break;
        case Loss::distribution:
            append(lesson.outcome, rows.numbers);
            break;
        case Loss::square:
            rows.numbers.push_back(lesson.value);
            break;
        case Loss::ownership:
            known = lesson.scored;
            append(lesson.ownership, rows.numbers);
            break;
        case Loss::score:
            known = lesson.scored;
            rows.numbers.push_back(lesson.lead);
            break;
        case Loss::moves_left:
            rows.numbers.push_back(lesson.moves_left);
            break;
    }
    rows.weights.push_back(known ? weight : 0.0f);
}

}  // namespace selfplay::training
