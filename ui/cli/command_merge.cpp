#include <algorithm>
#include <array>
#include <iostream>

#include "engine/core/file.h"
#include "engine/image/image_io.h"
#include "engine/measure/film_merge.h"
#include "ui/cli/commands.h"

namespace raylab {
namespace {

struct MergeOptions {
    std::vector<std::string> parts;
    std::string output;
};

ExitCode merge(const MergeOptions& options) {
    if (std::filesystem::path(options.output).extension() != ".exr")
        throw Error(options.output + ": what is merged keeps its variance and samples, which only .exr holds");
    requireWritable(options.output);
    std::vector<FilmPart> parts;
    for (const std::string& part : options.parts) parts.push_back(readFilmPart(part));
    const FilmPart whole = mergeFilms(parts);
    writeExr(options.output,
             std::array{Layer{"", whole.mean}, Layer{"variance", whole.variance}, Layer{"samples", whole.samples}},
             whole.metadata);
    const auto [least, most] = std::ranges::minmax(whole.samples.pixels);
    std::cout << options.output << "  " << parts.size() << " parts, " << least << (least < most ? " or more" : "")
              << " samples a pixel\n";
    return ExitCode::done;
}

}  // namespace

void addMergeCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("merge", "one picture of several renderings with different seeds");
    const auto options = std::make_shared<MergeOptions>();
    command->add_option("parts", options->parts, "EXR files that raylab render wrote with the same settings")
        ->type_name("PART.exr")
        ->required();
    command->add_option("-o,--output", options->output, "EXR file to write")->type_name("FILE")->required();
    command->callback([&chosen, options] { chosen = [options] { return merge(*options); }; });
}

}  // namespace raylab
