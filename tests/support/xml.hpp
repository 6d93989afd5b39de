#pragma once

#include <string>

namespace rheonet::test {

/// Why a text is no well-formed XML document of elements, attributes and text; "" if it is one.
std::string what_is_wrong_with_xml(const std::string& text);

}  // namespace rheonet::test
