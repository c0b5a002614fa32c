// config/object-trees.txt, which is compiled in: what stands without files needs no path to be right.
#pragma once

#include <string_view>

namespace redbee {

/// See BoostedTrees.
std::string_view objectTreesText();

}  // namespace redbee
