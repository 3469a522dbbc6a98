#include "place_arguments.h"

#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace
{

constexpr float kFarthest = 1e6f; // m

/// Three numbers between commas; none of what is no place.
std::optional<glm::vec3> placeIn(const std::string& text)
{
    const std::vector<std::string> words = CLI::detail::split(text, ',');
    glm::vec3 place;
    if (words.size() != 3) return std::nullopt;
    for (int axis = 0; axis < 3; ++axis) {
        float& number = place[axis];
        if (!CLI::detail::lexical_cast(words[static_cast<size_t>(axis)], number) ||
            !(std::abs(number) <= kFarthest))
            return std::nullopt;
    }
    return place;
}

std::optional<relamp::SamePaint> samePaintIn(const std::string& text)
{
    const std::vector<std::string> words = CLI::detail::split(text, ':');
    if (words.size() != 2) return std::nullopt;
    const auto a = placeIn(words[0]);
    const auto b = placeIn(words[1]);
    if (!a || !b) return std::nullopt;
    return relamp::SamePaint{*a, *b};
}

/// `in` reads one of them; `form` is what each has to be like.
template<class Value, class In>
CLI::Option& addEach(CLI::App& command, const char* name, std::vector<Value>& values,
                     const char* what, const char* form, const In& in)
{
    const auto take = [&values, name, form, in](const std::vector<std::string>& texts) {
        values.clear();
        for (const std::string& text : texts) {
            const auto value = in(text);
            if (!value)
                throw CLI::ValidationError(
                    name, fmt::format("\"{}\" is not {}, numbers in metres from {} to {}", text,
                                      form, -kFarthest, kFarthest));
            values.push_back(*value);
        }
    };
    CLI::Option* option = command.add_option_function<std::vector<std::string>>(name, take, what);
    return *option->type_name(form)->allow_extra_args(false)->take_all();
}

} // namespace

CLI::Option& addPlaces(CLI::App& command, const char* name, std::vector<glm::vec3>& places,
                       const char* what)
{
    return addEach(command, name, places, what, "X,Y,Z", placeIn);
}

CLI::Option& addPlaces(CLI::App& command, const char* name, std::vector<relamp::SamePaint>& same,
                       const char* what)
{
    return addEach(command, name, same, what, "X,Y,Z:X,Y,Z", samePaintIn);
}
