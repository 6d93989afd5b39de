#pragma once

#include <string>
#include <vector>

namespace rheonet::test {

/// A fenced block of a page.
struct Block {
  std::string language;
  std::string text;
};

/// The fenced blocks of a page, in order; the text between them has the language "-".
std::vector<Block> parts(const std::string& page);

/// The fenced blocks alone.
std::vector<Block> blocks(const std::string& page);

}  // namespace rheonet::test
