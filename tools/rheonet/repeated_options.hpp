#pragma once

#include <string>
#include <vector>

namespace rheonet::tool {

/// The words of a command line, `--set a=1 b=2 SCENE`, in which each PATH=VALUE that follows another gets a --set of its own:
/// an option that takes any number of words would swallow the scene. So with `--vary`, the measures after `--measure`, and the files after `--merge`.
std::vector<std::string> with_every_option(const std::vector<std::string>& words);

}  // namespace rheonet::tool
