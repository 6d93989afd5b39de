#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace rheonet::tables {

/// A MAT file that cannot be read. The text continues "FILE cannot be read: ".
struct MatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The content of a MAT file from which a table is made.
struct MatTable {
  struct Column {
    std::string name;
    std::vector<double> numbers;
  };
  std::vector<Column> columns;            ///< vectors, and columns of matrices
  std::vector<std::string> names, units;  ///< the cell arrays `columns` and `units`, with which rheonet names the vectors; empty if absent
  bool of_rheonet = false;                ///< written by rheonet, so that both exist
};

/// Adds a vector as a column `name`, or the columns of a matrix as `name_1`, `name_2` ... `number_at` gives the numbers, column by column.
template <class NumberAt>
void add_columns(MatTable& table, const std::string& name, std::size_t rows, std::size_t columns, NumberAt number_at) {
  const bool is_vector = rows == 1 || columns == 1;
  const std::size_t count = is_vector ? 1 : columns, length = is_vector ? rows * columns : rows;
  for (std::size_t k = 0; k < count; ++k) {
    MatTable::Column& column = table.columns.emplace_back(name + (is_vector ? "" : "_" + std::to_string(k + 1)), std::vector<double>(length));
    for (std::size_t row = 0; row < length; ++row) column.numbers[row] = number_at(k * length + row);
  }
}

/// The columns of the most frequent length as CSV, with the names and units of rheonet if there are any. Throws MatError if there is no
/// column, or if a file of rheonet has lost names.
std::string as_csv(MatTable table);

/// Reads a file with `read` and makes it CSV. Returns false and the reason if that throws MatError.
bool table_text(MatTable (*read)(const char* path), const char* path, std::string& text, std::string& why);

/// Reads a MAT file of level 5, which MATLAB writes up to version 7, SciPy and Octave. Every size is compared with the bytes that are left before it
/// is used. Throws MatError.
MatTable read_level5(const char* path);

}  // namespace rheonet::tables
