// How KataGo's networks since version 8 see Go: 22 planes and 19 numbers (FORMATS.md 1.5), rows
// from the top; the policy is y * size + x with a pass behind. A writer of our own from that
// description.
#pragma once

#include "engine/encoding.h"
#include "engine/go/go.h"

namespace go {

engine::Encoding<Go> katago_v7();

}  // namespace go
