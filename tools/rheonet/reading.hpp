#pragma once

#include "core/netlist/file_offer.hpp"
#include "core/network/error.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// How the command line says that a scene is to be read.
ReadOptions options_of(const Arguments& arguments);

/// Reads a scene and prints every mistake and warning on standard error. Without a scene in the result there was a
/// mistake.
ReadResult read_and_report(const std::string& scene, const ReadOptions& options);

/// Prints every mistake and warning of a scene that has been read, and the advice on it (core/network/advice.hpp).
void report_all(ReadResult& result);

/// The same from text, with nothing printed: see read_offered_text.
ReadResult read_text(const std::string& text, const std::string& name, const std::string& folder, const ReadOptions& options,
                     const std::vector<const FileOffer*>& offers);

/// Whether a file is one of those that a scene was read from, which must not be overwritten by its results. Says so if
/// it is; `option` is what names it: "--output".
bool is_source(const std::string& path, const char* option, const Sources& sources);

/// Prints on standard error why a scene that has been read cannot be simulated: with its place in the netlist, if it has one.
void report(const SimulationError& error, const Sources& sources);

}  // namespace rheonet::tool
