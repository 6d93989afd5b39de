#include "tools/draw/schematic.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/figure_file.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {

ExitStatus draw_network(const Arguments& arguments) {
  if (!can_be_figure(arguments.output, "--output")) return wrong_input;
  const ReadResult read = read_and_report(arguments.scene, options_of(arguments));
  if (!read.scene || is_source(arguments.output, "--output", read.sources)) return wrong_input;
  const draw::Look look{.title = arguments.title.empty() ? read.scene->title : arguments.title,
                        .values = !arguments.no_values,
                        .all = arguments.all,
                        .sources = &read.sources};
  try {
    const draw::Picture picture = draw::schematic(*read.scene, look);
    if (picture.omitted > 0)
      say("note: {} elements that repeat those beside them are not drawn; --all draws them\n", picture.omitted);
    return write_figure(draw::svg(picture, *read.scene), arguments.output);
  } catch (const plot::Mistake& mistake) {
    report(mistake);
    return wrong_input;
  }
}

}  // namespace rheonet::tool
