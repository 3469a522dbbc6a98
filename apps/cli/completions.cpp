#include "completions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace
{

std::string commandNames(const CommandTable& table)
{
    std::string names = "help";
    for (const CommandRow& row : table.commands) names += ' ' + row.name;
    return names;
}

std::string optionNames(const CommandRow& row)
{
    std::string names;
    for (const OptionRow& option : row.options)
        for (const std::string& name : option.names) names += (names.empty() ? "" : " ") + name;
    return names;
}

/// What may follow each option that takes a value which is no file.
std::string bashValues(const CommandRow& row)
{
    std::string text;
    for (const OptionRow& option : row.options) {
        if (option.value.empty() || (option.choices.empty() && option.takesFile())) continue;
        for (const std::string& name : option.names)
            text += fmt::format("        '{} {}') words='{}' ;;\n", row.name, name,
                                fmt::join(option.choices, " "));
    }
    return text;
}

std::string forBash(const CommandTable& table)
{
    std::string values;
    std::string options;
    for (const CommandRow& row : table.commands) {
        values += bashValues(row);
        options += fmt::format("            {}) words='{}' ;;\n", row.name, optionNames(row));
    }
    return fmt::format(
        R"(# Completion of relamp for bash.
_relamp() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} words= command=${{COMP_WORDS[1]}}
    local previous=${{COMP_WORDS[COMP_CWORD - 1]}}
    # "--solver=gather" comes as three words.
    if [[ $current == = ]]; then
        current=
    elif [[ $previous == = ]]; then
        previous=${{COMP_WORDS[COMP_CWORD - 2]}}
    fi
    COMPREPLY=()
    if ((COMP_CWORD == 1)) || [[ $COMP_CWORD == 2 && $command == help ]]; then
        mapfile -t COMPREPLY < <(compgen -W '{} {}' -- "$current")
        return
    fi
    case "$command $previous" in
{}        *)
            if [[ $current != -* ]]; then
                compopt -o filenames 2>/dev/null
                mapfile -t COMPREPLY < <(compgen -f -- "$current")
                return
            fi
            case $command in
{}            esac
            ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -F _relamp relamp
)",
        commandNames(table), optionNames(table.program), values, options);
}

/// Within single quotes, of which none may be inside.
std::string zshText(const std::string& text)
{
    std::string result;
    for (const char c : escaped(text, "\\[]:", "\\"))
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result;
}

std::string zshOptions(const CommandRow& row)
{
    std::string text;
    for (const OptionRow& option : row.options) {
        std::string value;
        if (!option.choices.empty())
            value = fmt::format(":{}:({})", zshText(option.value), fmt::join(option.choices, " "));
        else if (!option.value.empty())
            value =
                fmt::format(":{}:{}", zshText(option.value), option.takesFile() ? "_files" : " ");
        for (const std::string& name : option.names)
            text += fmt::format("            '{}{}[{}]{}' \\\n", option.isRepeatable ? "*" : "",
                                name, zshText(option.what), value);
    }
    return text;
}

std::string forZsh(const CommandTable& table)
{
    std::string names = "        'help:Tell more of a command'\n";
    std::string options;
    for (const CommandRow& row : table.commands) {
        names += fmt::format("        '{}:{}'\n", row.name, zshText(row.what));
        options += fmt::format("        {}) _arguments \\\n{}            '*:file:_files' ;;\n",
                               row.name, zshOptions(row));
    }
    return fmt::format(R"(#compdef relamp
# Completion of relamp for zsh.
_relamp() {{
    local -a commands=(
{}    )
    if (( CURRENT == 2 )) && [[ $words[2] == -* ]]; then
        compadd -- {}
        return
    elif (( CURRENT == 2 )) || [[ $CURRENT == 3 && $words[2] == help ]]; then
        _describe command commands
        return
    fi
    local command=$words[2]
    shift words
    (( CURRENT-- ))
    case $command in
{}    esac
}}
_relamp "$@"
)",
                       names, optionNames(table.program), options);
}

std::string fishOption(const OptionRow& option, const std::string& condition)
{
    std::string text = "complete -c relamp -n '" + condition + "'";
    for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.choices.empty())
        text += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
    else if (!option.value.empty())
        text += option.takesFile() ? " -r -F" : " -x";
    return text + " -d '" + escaped(option.what, "\\'", "\\") + "'\n";
}

std::string forFish(const CommandTable& table)
{
    std::string text = "# Completion of relamp for fish.\n";
    const std::string names = commandNames(table);
    text += "complete -c relamp -n __fish_use_subcommand -f -a help -d 'Tell more of a command'\n";
    text += "complete -c relamp -n '__fish_seen_subcommand_from help' -f -a '" + names + "'\n";
    for (const OptionRow& option : table.program.options)
        text += fishOption(option, "__fish_use_subcommand");
    for (const CommandRow& row : table.commands) {
        text += fmt::format("complete -c relamp -n __fish_use_subcommand -f -a {} -d '{}'\n",
                            row.name, escaped(row.what, "\\'", "\\"));
        for (const OptionRow& option : row.options)
            text += fishOption(option, "__fish_seen_subcommand_from " + row.name);
    }
    return text;
}

} // namespace

bool writeCompletions(const CommandTable& table, const std::string& folder)
{
    return writeText(folder + "/relamp", forBash(table)) &&
           writeText(folder + "/_relamp", forZsh(table)) &&
           writeText(folder + "/relamp.fish", forFish(table));
}
