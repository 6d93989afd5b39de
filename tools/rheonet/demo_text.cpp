#include "tools/rheonet/demo_text.hpp"

#include <fmt/format.h>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {

namespace {

constexpr int key_width = 8;

}  // namespace

std::string demo_text(const Demo& demo) {
  if (demo.question.empty()) return "";
  std::string text = "demo:\n";
  const auto add = [&text](const char* key, const std::string& said) {
    text += fmt::format("  {:<{}}  {}\n", key, key_width, wrapped(printable(said), key_width + 4));
  };
  add("question", demo.question);
  add("change", demo.change);
  add("see", demo.see);
  add("why", demo.why);
  std::string sliders;
  for (const Demo::Slider& slider : demo.sliders) {
    const std::string unit = slider.unit.empty() ? "" : ' ' + slider.unit;
    sliders += fmt::format("{}{} from {:g} to {:g}{}", sliders.empty() ? "" : ", ", slider.parameter, slider.least,
                           slider.most, unit);
    if (slider.step > 0) sliders += fmt::format(" in steps of {:g}{}", slider.step, unit);
  }
  if (!sliders.empty()) add("sliders", sliders);
  return text;
}

}  // namespace rheonet::tool
