#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "tools/rheonet/replacement.hpp"
#include "tools/rheonet/table_writer.hpp"

namespace rheonet::tool {

/// Where the results of a command go. It counts the rows, and remembers why a write failed (disk full, reader gone).
class Output {
 public:
  enum class Writing {
    as_it_comes,  ///< an existing file is emptied when the first row comes, not before; a full disk leaves whole rows
    complete,     ///< `close` replaces an existing file if every write succeeded; else the file stays as it is
  };

  /// `path` "-" is standard output. Throws std::system_error if the file cannot be opened for writing.
  explicit Output(const std::string& path, Writing writing = Writing::as_it_comes);
  /// A file whose first bytes are kept, so many with so many lines: what is written comes after them, and nothing of what
  /// stood there is lost before.
  Output(const std::string& path, std::size_t bytes, long lines);
  /// A table of another format, into which the rows of CSV are turned. It takes the place of an existing file when it is closed.
  Output(const std::string& path, std::unique_ptr<TableWriter> table);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Its buffer holds `buffered` bytes; who writes to it flushes it before a row would be split.
  std::FILE* file() { return file_; }
  static constexpr std::size_t buffered = 1 << 17;
  bool is_terminal() const;
  const std::string& name() const { return name_; }          ///< for messages: "`out.csv`"
  long rows() const { return lines_ > 0 ? lines_ - 1 : 0; }  ///< written so far, without the header
  /// What of a task that ended early is in it, in words: "  the 3 rows up to there are in `out.csv`\n".
  std::string kept(const char* row) const;

  /// Flushes all outputs of the process and blocks further writes, because the process is about to end. Any thread may call
  /// it while others write. The text of `kept` for each output that has rows.
  static std::string finish_all();

  /// Closes. The error of this or any earlier write (errno), 0 if all is written.
  int close();
  /// Closes, and leaves a file that was there before as it was, if it is written only when complete.
  void abandon();

 private:
  bool finish();
  long write(const char* text, std::size_t size);
  bool is_stalled() const;
  /// Before the first byte: makes room for it. The error (errno), 0 if it is done.
  int begin();
  /// Writes to a temporary file from now on.
  void write_beside();
  /// Writes to the file, or to the table, whatever its format; sets `error_`. How many bytes are written.
  std::size_t put(const char* text, std::size_t size);
  void drop_begun_row();

  std::string path_;
  std::string name_;
  std::FILE* file_ = nullptr;
  int descriptor_ = -1;
  int error_ = 0;
  long lines_ = 0;
  std::size_t begun_ = 0;  ///< bytes written since the last whole row
  bool created_ = false;
  bool touched_ = false;
  bool finishing_ = false;  ///< no write may wait for a reader any more
  std::size_t kept_ = 0;  ///< bytes of an earlier writing
  Writing writing_;
  bool abandoned_ = false;
  bool left_alone_ = false;  ///< closed without a change of the file
  int folder_ = -1;       ///< of the file, while it is replaced
  std::optional<Replacement> replacement_;
  std::unique_ptr<TableWriter> table_;  ///< nullptr for CSV
};

/// Opens it; nullptr, and an error message, if that is not possible.
std::unique_ptr<Output> open_output(const std::string& path, Output::Writing writing);

/// The same for rows as they come after so many bytes, with so many lines, of an earlier writing.
std::unique_ptr<Output> open_output_after(const std::string& path, std::size_t bytes, long lines);

/// A table of the layout, in the format that the ending of the name says: rows go to the Output as CSV. Without a format of its own
/// it is CSV.
std::unique_ptr<Output> open_table(const std::string& path, Output::Writing writing, tables::Layout layout);

/// Writes a text and closes; false, and an error message, if not all is written. `row`: what a line of it is called.
bool write_all(Output& output, const std::string& text, const char* row);

/// Whether rows can go to a file of this name, as CSV, or if `any_format` in one of the formats of `table_format`. Says so if it ends
/// as another format does; `option` is what names it: "--output".
bool can_be_table(const std::string& path, const char* option, bool any_format = false);

}  // namespace rheonet::tool
