#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rheonet {

/// One cell of a line of a CSV file.
struct CsvField {
  std::string_view text;  ///< without the quotes and blanks around it
  int column = 1;         ///< where it begins, in characters from 1
  bool decimal_comma = false;  ///< a comma in it can be nothing but that of a number
};

/// The fields of a line, split at semicolons if it has any, else at commas, else at blanks and tabs: a unit in square
/// brackets stays with the name before it. A field may stand
/// in quotes, as spreadsheets write them, and may then have such separators in it. Where semicolons split, numbers may be
/// written with a comma, as spreadsheets of half the world do.
std::vector<CsvField> csv_fields(std::string_view line);

/// Whether a line is empty, or begins with `#`.
bool is_csv_remark(std::string_view line);

/// The number that a field is; nothing if it is none.
std::optional<double> csv_number(std::string_view text);
std::optional<double> csv_number(const CsvField& field);

/// A field as netlists write it: a number with a point, anything else as it is.
std::string csv_text(const CsvField& field);

/// A field of a header: "velocity [mm/s]" or "velocity (mm/s)".
struct CsvHeading {
  std::string_view name;
  std::string_view unit;  ///< "": none
  bool square = false;    ///< in square brackets: it can be nothing but a unit
};
CsvHeading csv_heading(std::string_view field);

}  // namespace rheonet
