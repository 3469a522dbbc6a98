#include "scan_arguments.h"

CLI::Validator between(double low, double high)
{
    const auto check = [low, high](const std::string& text) {
        double value = 0.0;
        const bool isBetween =
            CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return isBetween ? "" : fmt::format("{} is not between {} and {}", text, low, high);
    };
    return {check, ""};
}

void refuseEmptyValues(CLI::App& app)
{
    const auto check = [](const std::string& text) {
        return text.empty() ? std::string("is empty; name something, or leave the option out") : "";
    };
    for (CLI::Option* option : app.get_options())
        if (option->get_expected_min() > 0 &&
            !option->check_name("--skip-mesh")) // may have no name
            option->check(CLI::Validator(check, ""));
    for (CLI::App* command : app.get_subcommands({})) refuseEmptyValues(*command);
}

void addScanArguments(CLI::App& command, ScanArguments& arguments)
{
    command.add_option("scan", arguments.file, "glTF, GLB, OBJ, PLY, or what else Assimp reads")
        ->required()
        ->type_name("SCAN");
    addReadingArguments(command, arguments);
}

void addReadingArguments(CLI::App& command, ScanArguments& arguments)
{
    relamp::ScanOptions& options = arguments.options;
    command
        .add_option("--up", options.up, "The file's axis that points to the ceiling: y or z [y]")
        ->transform(oneOf<relamp::UpAxis>())
        ->type_name("AXIS");
    command.add_option("--scale", options.scale, "Metres a unit of the file [1]")
        ->check(between(1e-6, 1e6))
        ->type_name("M");
    command
        .add_option("--transfer", options.transfer,
                    "What the texture's numbers are: srgb, linear, or auto by type [auto]")
        ->transform(oneOf<relamp::Transfer>())
        ->type_name("CURVE");
    command
        .add_option("--skip-mesh", options.skipMeshes, "Leave out meshes of this name (repeatable)")
        ->type_name("NAME")
        ->allow_extra_args(false);
    command.add_flag("--allow-outside", options.allowOutside,
                     "Let the scan name files outside of its folder; a stranger's could carry them "
                     "off");
    command.add_flag("--allow-overlap", options.allowOverlap,
                     "Go on where many texels stand for several places");
    command.add_option("--threads", arguments.threads, "Threads to work with; 0 is one a core [0]")
        ->check(between(0, 1024))
        ->type_name("N");
}

void addEngineArguments(CLI::App& command, relamp::EngineOptions& engine, const std::string& what)
{
    command
        .add_option(
            "--engine", engine.engine,
            fmt::format("What computes {}: cpu, gpu, or auto: a real GPU if there is one [auto]",
                        what))
        ->transform(oneOf<relamp::Engine>())
        ->type_name("NAME");
    command
        .add_option("--gpu", engine.gpu,
                    "The GPU to work on: its index or a part of its name, of relamp devices")
        ->type_name("GPU");
}
