#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/file_offer.hpp"
#include "tools/report/messages.hpp"

// The lesson of a netlist: a prediction to make before the run is shown, values to try by a button, and an explanation. It stands
// beside the netlist, bingham.lesson beside bingham.toml. netlists/teaching/README.md describes the format.
namespace rheonet::serve {

/// The file of the lesson of a netlist: "teaching/bingham.lesson" for "teaching/bingham.toml".
std::string lesson_file_of(const std::string& netlist);

/// What a gallery says of a lesson.
struct LessonGlance {
  std::string level;  ///< "beginner", "intermediate", "advanced"; "" if the file does not say
  double minutes = 0;
};
LessonGlance glance_at_lesson(const std::string& text);

/// The message `lesson`, in the language of the task; or `mistakes` with the mistakes of the lesson's file, whose curves and values
/// are checked against the netlist. Without a lesson nothing is told.
void tell_lesson(const nlohmann::json& task, const std::vector<const FileOffer*>& offers, const report::Tell& tell);

}  // namespace rheonet::serve
