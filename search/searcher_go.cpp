// The search of one game, compiled here once for all who use it.
#include "search/searcher.h"

namespace search {

template class Searcher<go::Go>;

}  // namespace search
