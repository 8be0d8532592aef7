// The session of one game, compiled here once for all front ends.
#include "protocols/session.h"

namespace protocols {

template class GameSession<chess::Chess>;

}  // namespace protocols
