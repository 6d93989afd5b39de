#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/file_offer.hpp"
#include "tools/report/messages.hpp"

// The lesson of a netlist: a prediction before the run is shown, values to try, and an explanation. Its file is next to the netlist:
// bingham.lesson for bingham.toml. netlists/teaching/README.md describes the format.
namespace rheonet::serve {

/// The file of a netlist's lesson: "teaching/bingham.lesson" for "teaching/bingham.toml".
std::string lesson_file_of(const std::string& netlist);

/// The entry of a lesson in the gallery.
struct LessonGlance {
  std::string level;  ///< "beginner", "intermediate", "advanced"; "": unspecified.
  double minutes = 0;
  std::map<std::string, std::string> titles;  ///< The title of the netlist by language: "de".
};
LessonGlance glance_at_lesson(const std::string& text);

/// Sends the message `lesson` in the language of the task, or `mistakes` with the mistakes of the lesson's file, whose curves and values are
/// checked against the netlist. The task has the text of the `lesson`, or else its file is read. Sends nothing if there is no lesson.
void tell_lesson(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

}  // namespace rheonet::serve
