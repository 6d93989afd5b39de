#pragma once

#include <string>
#include <vector>

#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/document.hpp"

namespace rheonet {

/// The element of a law among the parts that laws_to_models makes. In a scene it has the path of the instance itself.
inline constexpr const char* law_element = "law";

/// Turns each entry of `[laws]` into a model with the ports `a` and `b`:
///
///     law   an element whose force, and whose stored energy, are the outputs of the blocks `f` and `E`
///     f, E  functions of the displacement d and the velocity w of `law`, the time t, the states, the inputs, and the names in `where`
///     z     an integrator for each state z, fed by the function z_rate
///
/// A name in `where` is a function too. A wire with the name of an input comes from what the instance gives for it.
void laws_to_models(TomlValue& document, DiagnosticList& diagnostics);

/// The name of a block of a law in messages: "`force`" of the block f.
std::string law_part(const std::string& block);
/// Text about an expression of a law, as its author wrote it: with rate(z) for the input z_rate.
std::string in_words_of_law(std::string text, const std::vector<std::string>& inputs);

}  // namespace rheonet
