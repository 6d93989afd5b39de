#pragma once

#include <string>
#include <vector>

namespace rheonet::tool {

/// Expands a command line such as `--set a=1 b=2 SCENE` so that each PATH=VALUE has its own --set: an option with any number of values
/// would swallow the scene. The same holds for `--vary`, the measures after `--measure`, and the files after `--merge`.
std::vector<std::string> with_every_option(const std::vector<std::string>& words);

}  // namespace rheonet::tool
