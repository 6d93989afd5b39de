#pragma once

#include <string_view>

namespace rheonet::web {

/// The files for the browser, bundled when rheonet was built: see README.md. Empty if that could not be done.
struct Asset {
  std::string_view text;
  const char* type;  ///< Content type.
  std::string_view gzipped = {};  ///< The text compressed with gzip; empty for small files.
};

Asset report_page();       ///< complete but for its data
Asset playground_page();
Asset playground_style();
Asset playground_script();
Asset token_page();        ///< the answer to a request without the server's token
Asset notice();            ///< the licences of the packages and fonts in the pages

/// Whether there is any; if not, why not, and how to get it.
bool are_built();
const char* why_not_built();

}  // namespace rheonet::web
