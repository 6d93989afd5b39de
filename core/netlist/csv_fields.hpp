#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rheonet {

/// One cell of a line of a CSV file.
struct CsvField {
  std::string_view text;  ///< without surrounding quotes and blanks
  int column = 1;         ///< first character, counted from 1
  bool decimal_comma = false;  ///< a comma inside the field can only be a decimal comma
};

/// The fields of a line, split at semicolons if it has any, else at commas, else at blanks and tabs. A unit in square
/// brackets stays with the name before it. A field may stand in quotes, as spreadsheets write them, and may then contain
/// separators. In a line split at semicolons numbers may have a decimal comma.
std::vector<CsvField> csv_fields(std::string_view line);

/// Whether a line is empty, or begins with `#`.
bool is_csv_remark(std::string_view line);

/// The number in a field; absent if the field is not a number.
std::optional<double> csv_number(std::string_view text);
std::optional<double> csv_number(const CsvField& field);

/// A field as netlists write it: a number with a decimal point, any other text unchanged.
std::string csv_text(const CsvField& field);

/// A field of a header: "velocity [mm/s]" or "velocity (mm/s)".
struct CsvHeading {
  std::string_view name;
  std::string_view unit;  ///< "" if absent
  bool square = false;    ///< the unit stands in square brackets, which can only enclose a unit
};
CsvHeading csv_heading(std::string_view field);

}  // namespace rheonet
