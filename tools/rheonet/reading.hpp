#pragma once

#include "core/netlist/file_offer.hpp"
#include "core/network/error.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// The options for reading a scene, from the command line.
ReadOptions options_of(const Arguments& arguments);

/// Reads a scene and prints every mistake and warning on standard error. The result has no scene if there was a mistake.
ReadResult read_and_report(const std::string& scene, const ReadOptions& options);

/// Prints every mistake and warning of a scene that has been read, and the advice on it (core/network/advice.hpp).
void report_all(ReadResult& result);

/// Reads a scene from text and prints nothing; see read_offered_text.
ReadResult read_text(const std::string& text, const std::string& name, const std::string& folder, const ReadOptions& options,
                     const std::vector<const FileOffer*>& offers);

/// Whether a scene was read from this file, so that its results must not overwrite it. Prints an error if so. `option` is the option that
/// names the file: "--output".
bool is_source(const std::string& path, const char* option, const Sources& sources);

/// Prints on standard error why a scene cannot be simulated, with the place in the netlist if there is one.
void report(const SimulationError& error, const Sources& sources);

}  // namespace rheonet::tool
