#include "manual.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>

namespace
{

/// As roff prints it: a dash stays a dash, and no line begins with a request.
std::string roff(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
            result += std::string("\\&") + c;
        else
            result += c;
    }
    return result;
}

std::string entry(const OptionRow& option)
{
    std::string head;
    for (const std::string& name : option.names)
        head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", roff(name));
    if (!option.value.empty())
        head += fmt::format("{}\\fI{}\\fR", head.empty() ? "" : " ", roff(option.value));
    std::string choices;
    for (const std::string& choice : option.choices)
        choices += (choices.empty() ? "One of " : ", ") + roff(choice);
    if (!choices.empty()) choices = ".br\n" + choices + ".\n";
    return fmt::format(".TP\n{}{}\n{}\n{}", head, option.isRequired ? " (required)" : "",
                       roff(option.what), choices);
}

std::string entries(const char* title, const std::vector<OptionRow>& rows)
{
    std::string text = rows.empty() ? "" : fmt::format(".SH {}\n", title);
    for (const OptionRow& row : rows) text += entry(row);
    return text;
}

std::string examples(const CommandRow& row)
{
    const size_t first = row.examples.find('\n');
    if (first == std::string::npos) return "";
    return fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n", roff(row.examples.substr(first + 1)));
}

std::string heading(const std::string& name, const std::string& what)
{
    std::string title = name;
    for (char& c : title)
        if (c >= 'a' && c <= 'z') c += 'A' - 'a';
    return fmt::format(".TH {} 1\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", roff(title), roff(name),
                       roff(what));
}

std::string synopsis(const CommandRow& row)
{
    std::string text = fmt::format("\\fBrelamp {}\\fR", roff(row.name));
    for (const OptionRow& argument : row.arguments)
        text += fmt::format(fmt::runtime(argument.isRequired ? " \\fI{}\\fR" : " [\\fI{}\\fR]"),
                            roff(argument.value));
    for (const OptionRow& option : row.options)
        if (option.isRequired)
            text +=
                fmt::format(" \\fB{}\\fR \\fI{}\\fR", roff(option.names[0]), roff(option.value));
    return text + (row.options.empty() ? " [\\fIARGUMENT\\fR ...]\n" : " [\\fIOPTION\\fR ...]\n");
}

std::string pageOf(const CommandRow& row)
{
    std::string text = heading("relamp-" + row.name, row.what) + synopsis(row) +
                       entries("ARGUMENTS", row.arguments) + entries("OPTIONS", row.options);
    if (row.options.empty()) // it hands them on to a program of its own
        text +=
            fmt::format(".SH OPTIONS\n\\fBrelamp {} \\-\\-help\\fR tells them.\n", roff(row.name));
    return text + examples(row) + ".SH SEE ALSO\n.BR relamp (1)\n";
}

std::string pageOf(const CommandTable& table, const std::string& beyond)
{
    std::string text =
        heading("relamp", "take the light out of a scanned room and put your own in");
    std::string commands = ".SH COMMANDS\n";
    for (const CommandRow& row : table.commands) {
        text += synopsis(row) + ".br\n";
        commands += fmt::format(".TP\n.BR relamp\\-{} (1)\n{}\n", row.name, roff(row.what));
    }
    text += "\\fBrelamp help\\fR [\\fICOMMAND\\fR]\n";
    return text + beyond + commands + entries("OPTIONS", table.program.options) +
           examples(table.program);
}

} // namespace

bool writeManual(const CommandTable& table, const std::string& folder, const std::string& beyond)
{
    std::ostringstream text;
    if (!(text << std::ifstream(beyond).rdbuf())) return false;
    if (!writeText(folder + "/relamp.1", pageOf(table, text.str()))) return false;
    for (const CommandRow& row : table.commands)
        if (!writeText(fmt::format("{}/relamp-{}.1", folder, row.name), pageOf(row))) return false;
    return true;
}
