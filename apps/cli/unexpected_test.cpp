#include "unexpected.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace
{

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What a person is told of whatever `work` throws.
template<class Work>
std::string sentenceAfter(const Work& work)
{
    try {
        work();
    } catch (const std::exception& unexpected) {
        return sentenceOf(unexpected);
    }
    return "";
}

} // namespace

TEST(Unexpected, NobodyIsToldHowALibraryIsMade)
{
    const std::vector<std::string> sentences{
        sentenceAfter([] { static_cast<void>(nlohmann::json("a").get<int>()); }),
        sentenceAfter([] { const auto none = nlohmann::json::parse("{"); }),
        sentenceAfter([] { std::vector<int>().reserve(~size_t{0}); }),
        sentenceAfter([] { throw std::bad_alloc(); }),
        sentenceAfter([] { static_cast<void>(std::vector<int>().at(1)); }),
        sentenceAfter([] { static_cast<void>(std::string().substr(1)); }),
        sentenceAfter([] { static_cast<void>(std::stoi("x")); }),
        sentenceAfter([] { static_cast<void>(std::filesystem::file_size("/none")); })};
    for (const std::string& sentence : sentences)
        EXPECT_THAT(sentence,
                    AllOf(Not(""), Not(HasSubstr("[json")), Not(HasSubstr("std::")),
                          Not(HasSubstr("vector")), Not(HasSubstr("basic_string")),
                          Not(HasSubstr("bad_")), Not(HasSubstr("stoi")), Not(HasSubstr("_M_"))));
    EXPECT_THAT(sentences.back(), HasSubstr("/none: No such file"));
}
