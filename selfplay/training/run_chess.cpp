// The run of one game, compiled here once.
#include "selfplay/training/run.h"

namespace selfplay::training {

template class Run<chess::Chess>;

}  // namespace selfplay::training
