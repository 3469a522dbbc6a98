#include "light_arguments.h"

#include "pipes.h"

#include <utility>

void LightArguments::readPipe()
{
    constexpr size_t kMostPiped = size_t{16} << 20; // bytes
    if (isPipe(file)) piped = readPiped(kMostPiped);
}

relamp::Relighting LightArguments::in(const relamp::Lights& captured, relamp::Relighting otherwise,
                                      std::vector<std::string>& warnings) const
{
    relamp::Relighting lighting =
        file.empty()   ? std::move(otherwise)
        : isPipe(file) ? relamp::RelightingReader().read(piped, file, captured, warnings)
                       : relamp::readRelighting(file, captured, warnings);
    for (const std::string& setting : fixtures) relamp::setFixture(lighting, captured, setting);
    return lighting;
}

void addLightArguments(CLI::App& command, LightArguments& arguments, const std::string& ofFile,
                       const std::string& ofFixtures)
{
    command
        .add_option("--lights", arguments.file,
                    ofFile + ": a lights file (docs/guide/lights.md), or - for standard input")
        ->type_name("FILE");
    command.add_option("--fixture", arguments.fixtures, ofFixtures + " (repeatable)")
        ->type_name("N=WHAT")
        ->allow_extra_args(false);
}
