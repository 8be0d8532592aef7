#include "selfplay/alphago/stage.h"

#include "engine/base/files.h"

namespace selfplay::alphago {

void tell(const StageInput& input, const std::filesystem::path& journal, const std::string& line) {
    engine::append_file(journal, line + '\n');
    input.report(line);
}

}  // namespace selfplay::alphago
