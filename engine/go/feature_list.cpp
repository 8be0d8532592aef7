#include "engine/go/feature_list.h"

#include "engine/go/feature_board.h"

namespace go {

namespace {

template <int most_size, Colour colour>
class Lister {
   public:
    Lister(const Go& game, FeatureList& list)
        : game_(game), list_(list), position_(game), answers_(Board::cell_count) {
        position_.template for_each_answer<colour>([&](int at, int feature) {
            answers_[static_cast<std::size_t>(at)].push_back(feature);
        });
    }

    void run() {
        list_.moves.clear();
        list_.features.clear();
        list_.rollout_ends.clear();
        list_.starts.assign(1, 0);
        for (int y = 0; y < game_.size(); ++y)
            for (int x = 0; x < game_.size(); ++x) add({x, y});
    }

   private:
    using Board = RolloutBoard<most_size, true>;

    static int pattern(std::uint16_t surroundings) {
        return features::patterns_of_black()[colour == Colour::black
                                                 ? surroundings
                                                 : features::colours_exchanged(surroundings)];
    }
    int listed() const { return static_cast<int>(list_.features.size()); }

    void add(Point point) {
        const int at = Board::index(point);
        const auto& board = position_.board();
        if (board.at(at) != Colour::empty || at == board.ko()) return;
        const auto contact = position_.template contact<colour>(at);
        if (!contact) return;
        auto& features = list_.features;
        features.push_back(pattern(board.surroundings(at)));
        features.push_back(*contact);
        if (const auto line = position_.line(at)) features.push_back(*line);
        const auto& answers = answers_[static_cast<std::size_t>(at)];
        features.insert(features.end(), answers.begin(), answers.end());
        list_.rollout_ends.push_back(listed());
        position_.template for_each_tree_feature<colour>(
            at, [&](int feature) { features.push_back(feature); });
        list_.starts.push_back(listed());
        list_.moves.push_back(game_.move_at(point));
    }

    const Go& game_;
    FeatureList& list_;
    FeatureBoard<most_size> position_;
    std::vector<std::vector<int>> answers_;
};

template <int most_size>
void list_on(const Go& game, FeatureList& list) {
    if (game.to_play() == Player::first)
        Lister<most_size, Colour::black>(game, list).run();
    else
        Lister<most_size, Colour::white>(game, list).run();
}

}  // namespace

void list_features(const Go& game, FeatureList& list) {
    const auto list_on_board = game.size() <= 9    ? list_on<9>
                               : game.size() <= 13 ? list_on<13>
                               : game.size() <= 19 ? list_on<19>
                                                   : list_on<25>;
    list_on_board(game, list);
}

}  // namespace go
