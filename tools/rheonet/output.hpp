#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/rheonet/replacement.hpp"
#include "tools/rheonet/table_writer.hpp"

namespace rheonet::tool {

/// The file or stream for the results of a command. It counts the rows and keeps the error of a failed write (disk full, pipe closed).
class Output {
 public:
  enum class Writing {
    as_it_comes,  ///< The first row empties an existing file; a full disk leaves complete rows.
    complete,     ///< `close` replaces an existing file if every write succeeded, and otherwise leaves it unchanged.
  };

  /// `path` "-" is standard output. Throws std::system_error if the file cannot be opened for writing.
  explicit Output(const std::string& path, Writing writing = Writing::as_it_comes);
  /// Appends to the first `bytes` bytes (`lines` lines) of an existing file. The rest of the file is kept until the first write.
  Output(const std::string& path, std::size_t bytes, long lines);
  /// Converts the rows of CSV into a table of another format, which replaces an existing file when it is closed.
  Output(const std::string& path, std::unique_ptr<TableWriter> table);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// The stream to write to. Its buffer holds `buffered` bytes; flush it before a row would be split.
  std::FILE* file() { return file_; }
  static constexpr std::size_t buffered = 1 << 17;
  bool is_terminal() const;
  const std::string& name() const { return name_; }          ///< For messages: "`out.csv`".
  long rows() const { return lines_ > 0 ? lines_ - 1 : 0; }  ///< Written so far, without the header.
  /// A sentence on the rows of a task that ended early: "  the 3 rows up to there are in `out.csv`\n".
  std::string kept(const char* row) const;

  /// Flushes all outputs of the process and blocks further writes. Call it just before the process ends, on any thread, even while others
  /// write. Returns the text of `kept` for each output that has rows.
  static std::string finish_all();

  /// Closes the output. Returns the error (errno) of this or any earlier write, 0 if all writes succeeded.
  int close();
  /// Closes the output. With `Writing::complete`, an existing file stays unchanged.
  void abandon();

 private:
  bool finish();
  long write(const char* text, std::size_t size);
  bool is_stalled() const;
  /// Empties the file before the first byte is written. Returns the error (errno) or 0.
  int begin();
  /// Redirects all writes to a temporary file.
  void write_beside();
  /// Writes to the file or to the table; sets `error_`. Returns the number of bytes written.
  std::size_t put(const char* text, std::size_t size);
  void drop_begun_row();

  std::string path_;
  std::string name_;
  std::FILE* file_ = nullptr;
  int descriptor_ = -1;
  int error_ = 0;
  long lines_ = 0;
  std::size_t begun_ = 0;  ///< Bytes written since the last complete row.
  bool created_ = false;
  bool touched_ = false;
  bool finishing_ = false;  ///< Writes no longer wait for a reader.
  std::size_t kept_ = 0;  ///< Bytes of an existing file that are kept.
  Writing writing_;
  bool abandoned_ = false;
  bool left_alone_ = false;  ///< Closed without a change of the file.
  int folder_ = -1;       ///< Descriptor of the file's folder while the file is replaced.
  std::optional<Replacement> replacement_;
  std::unique_ptr<TableWriter> table_;  ///< nullptr for CSV.
};

/// Opens an output. Returns nullptr, after an error message, if that is not possible.
std::unique_ptr<Output> open_output(const std::string& path, Output::Writing writing);

/// The same for rows that are appended to the first `bytes` bytes (`lines` lines) of an existing file.
std::unique_ptr<Output> open_output_after(const std::string& path, std::size_t bytes, long lines);

/// Opens a table in the format of the file's ending, CSV if the ending is not that of another format. Rows are written to the Output as CSV.
std::unique_ptr<Output> open_table(const std::string& path, Output::Writing writing, tables::Layout layout);

/// Writes a text and closes. Returns false, after an error message, if it could not be written completely. `row` is the word for a line.
bool write_all(Output& output, const std::string& text, const char* row);

/// Whether rows can be written to a file of this name, as CSV, or with `any_format` also in the formats of `table_format`. Prints an error
/// if the ending is that of another format. `option` is the option that names the file: "--output".
bool can_be_table(const std::string& path, const char* option, bool any_format = false);

/// Whether two of the outputs, options with their open files ("" for none), go to one file, where they would overwrite each other. Prints an error if so.
bool write_to_one_file(const std::vector<std::pair<const char*, std::string>>& outputs);

/// Whether JSON can be written to a file of this name ("": no file is asked for). Prints an error if the ending is not .json.
bool can_be_json(const std::string& path, const char* option);

}  // namespace rheonet::tool
