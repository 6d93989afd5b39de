#include "tools/web/assets.hpp"

#ifdef RHEONET_WEB_ASSETS
// The assembler takes a file in as it is, which no compiler does quickly.
#define EMBED(name, file)                                             \
  asm(".section .rodata\n"                                            \
      ".global rheonet_web_" #name "\n"                               \
      "rheonet_web_" #name ":\n"                                      \
      ".incbin \"" RHEONET_WEB_ASSETS "/" file "\"\n"                 \
      ".global rheonet_web_" #name "_end\n"                           \
      "rheonet_web_" #name "_end:\n"                                  \
      ".byte 0\n"                                                     \
      ".previous\n");                                                 \
  extern "C" const char rheonet_web_##name[], rheonet_web_##name##_end[];

EMBED(report, "report.html")
EMBED(page, "playground.html")
EMBED(style, "playground.css")
EMBED(script, "playground.js")
EMBED(gzipped_style, "playground.css.gz")
EMBED(gzipped_script, "playground.js.gz")
EMBED(token, "token.html")
EMBED(notice, "NOTICE")
#define TEXT(name) std::string_view(rheonet_web_##name, rheonet_web_##name##_end)
#else
#define TEXT(name) std::string_view()
#endif

namespace rheonet::web {

Asset report_page() { return {TEXT(report), "text/html; charset=utf-8"}; }
Asset playground_page() { return {TEXT(page), "text/html; charset=utf-8"}; }
Asset playground_style() { return {TEXT(style), "text/css; charset=utf-8", TEXT(gzipped_style)}; }
Asset playground_script() { return {TEXT(script), "text/javascript; charset=utf-8", TEXT(gzipped_script)}; }
Asset token_page() { return {TEXT(token), "text/html; charset=utf-8"}; }
Asset notice() { return {TEXT(notice), "text/plain; charset=utf-8"}; }

bool are_built() { return !report_page().text.empty(); }

const char* why_not_built() {
#ifdef RHEONET_WEB_ASSETS
  return "its web pages are missing: when rheonet was built, npm could not get the packages that they are made of\n"
         "  build it again where npm reaches its registry";
#else
  return "its web pages are missing: rheonet was built without Node.js and npm, or with -DRHEONET_WEB=OFF\n"
         "  install both (Debian: nodejs, npm) and build it again";
#endif
}

}  // namespace rheonet::web
