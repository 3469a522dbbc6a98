#include "command_table.h"

#include <fstream>
#include <iterator>
#include <sstream>

namespace
{

/// oneOf names its validator after what it takes.
std::vector<std::string> choicesOf(CLI::Option& option)
{
    const std::string start = "one of ";
    try {
        for (int i = 0;; ++i) {
            const std::string& name = option.get_validator(i)->get_name();
            if (!name.starts_with(start)) continue;
            std::istringstream words(name.substr(start.size()));
            return {std::istream_iterator<std::string>(words), {}};
        }
    } catch (const CLI::OptionNotFound&) {
        return {}; // that was the last
    }
}

OptionRow rowOf(CLI::Option& option)
{
    OptionRow row;
    for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
    if (option.get_items_expected_max() > 0) row.value = option.get_type_name();
    row.what = option.get_description();
    row.choices = choicesOf(option);
    row.isRequired = option.get_required();
    row.isRepeatable = option.get_expected_max() > 1;
    return row;
}

CommandRow rowOf(const CLI::App& app)
{
    CommandRow row{app.get_name(), app.get_description(), app.get_footer(), {}, {}};
    for (const CLI::Option* constant : app.get_options()) {
        auto& option = const_cast<CLI::Option&>(*constant); // get_validator is not const
        (option.get_positional() ? row.arguments : row.options).push_back(rowOf(option));
    }
    return row;
}

} // namespace

bool OptionRow::takesFile() const
{
    for (const char* word : {"FILE", "DIR", "SCAN", "CAMERA"})
        if (value.find(word) != std::string::npos) return true;
    return false;
}

CommandTable commandTable(const CLI::App& app)
{
    CommandTable table{rowOf(app), {}};
    for (const CLI::App* command : app.get_subcommands({}))
        table.commands.push_back(rowOf(*command));
    for (CommandRow& row : table.commands) // CLI11 hands it down to a command that has none
        if (row.examples == table.program.examples) row.examples.clear();
    return table;
}

std::string escaped(const std::string& text, const std::string& special, const std::string& escape)
{
    std::string result;
    for (const char c : text) {
        if (special.find(c) != std::string::npos) result += escape;
        result += c;
    }
    return result;
}

bool writeText(const std::string& path, const std::string& text)
{
    std::ofstream file(path);
    file << text;
    file.close();
    return !file.fail();
}
