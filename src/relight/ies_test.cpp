#include "relight/ies.h"

#include "scenes/refusal.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;

IesPhotometry parsed(const std::string& text)
{
    return parseIes(std::as_bytes(std::span(text)), "lamp.ies");
}

std::string refusalOfIes(const std::string& text)
{
    return scenes::refusalOf([&] { parsed(text); });
}

/// A file with these horizontal angles whose intensity is candela(vertical, horizontal), degrees.
template<class Candela>
std::string iesOf(const std::vector<double>& horizontals, const Candela& candela,
                  double lowest = 0.0, double highest = 180.0, double step = 5.0)
{
    std::vector<double> verticals;
    for (double v = lowest; v <= highest; v += step) verticals.push_back(v);
    std::string text = fmt::format("IESNA:LM-63-2002\r\n[TEST] made up\r\n[MANUFAC] relamp\r\n"
                                   "TILT=NONE\r\n1 1000 1.0 {} {} 1 2 0.1 0.1 0\r\n1.0 1.0 12\r\n",
                                   verticals.size(), horizontals.size());
    for (const double v : verticals) text += fmt::format("{} ", v);
    text += "\r\n";
    for (const double h : horizontals) text += fmt::format("{},", h);
    for (const double h : horizontals) {
        text += "\r\n";
        for (const double v : verticals) text += fmt::format("{:.6f} ", candela(v, h));
    }
    return text + "\r\n\x1a";
}

double even(double, double)
{
    return 100.0;
}

float at(const IesPhotometry& photometry, double vertical, double horizontal)
{
    return photometry.profile->at(static_cast<float>(glm::radians(vertical)),
                                  static_cast<float>(glm::radians(horizontal)));
}

} // namespace

// 100 cd in all directions are 400 pi lm.
TEST(Ies, LumensAreTheIntegralOverTheSphere)
{
    const float whole = 400.0f * glm::pi<float>();
    EXPECT_NEAR(parsed(iesOf({0}, even)).lumens, whole, 0.1f);
    EXPECT_NEAR(parsed(iesOf({0, 45, 90}, even)).lumens, whole, 0.1f);
    EXPECT_NEAR(parsed(iesOf({0, 20, 180}, even)).lumens, whole, 0.1f);
    EXPECT_NEAR(parsed(iesOf({90, 120, 270}, even)).lumens, whole, 0.1f);
    EXPECT_NEAR(parsed(iesOf({0, 120, 240, 360}, even)).lumens, whole, 0.1f);
    EXPECT_NEAR(parsed(iesOf({0, 120, 240}, even)).lumens, whole, 0.1f);
    EXPECT_NEAR(parsed(iesOf({0}, even, 0.0, 90.0)).lumens, 0.5f * whole, 0.1f);
    EXPECT_NEAR(parsed(iesOf({0}, even, 90.0, 180.0)).lumens, 0.5f * whole, 0.5f);
}

// A matte panel that looks down has I cos and gives pi I.
TEST(Ies, MattePanelGivesPiTimesItsPeak)
{
    const auto matte = [](double v, double) { return 300.0 * std::cos(glm::radians(v)); };
    const IesPhotometry panel = parsed(iesOf({0}, matte, 0.0, 90.0, 1.0));
    EXPECT_NEAR(panel.peak, 300.0f, 1e-3f);
    EXPECT_NEAR(panel.lumens, 300.0f * glm::pi<float>(), 0.3f);
    EXPECT_NEAR(at(panel, 60.0, 123.0), 150.0f, 0.1f);
    EXPECT_EQ(at(panel, 91.0, 0.0), 0.0f);
}

TEST(Ies, IsLinearBetweenTheAngles)
{
    const IesPhotometry lamp = parsed(
        iesOf({0, 90, 180, 270, 360}, [](double v, double h) { return v + (h == 90 ? 100 : 0); }));
    EXPECT_NEAR(at(lamp, 12.5, 0.0), 12.5f, 1e-3f);
    EXPECT_NEAR(at(lamp, 50.0, 45.0), 100.0f, 1e-2f);
    EXPECT_NEAR(at(lamp, 50.0, 315.0), 50.0f, 1e-2f);
}

// What a file leaves out is what LM-63 says: a quarter, a half from 0, a half from 90.
TEST(Ies, SymmetryFillsTheCircle)
{
    const auto lobed = [](double, double h) { return 10.0 + h; };
    const IesPhotometry quarter = parsed(iesOf({0, 30, 90}, lobed));
    for (const double h : {30.0, 150.0, 210.0, 330.0})
        EXPECT_NEAR(at(quarter, 40.0, h), 40.0f, 1e-2f) << h;
    const IesPhotometry half = parsed(iesOf({0, 30, 180}, lobed));
    EXPECT_NEAR(at(half, 40.0, 330.0), 40.0f, 1e-2f);
    EXPECT_NEAR(at(half, 40.0, 180.0), 190.0f, 1e-2f);
    const IesPhotometry side = parsed(iesOf({90, 150, 270}, lobed));
    EXPECT_NEAR(at(side, 40.0, 30.0), 160.0f, 1e-2f);
    EXPECT_NEAR(at(side, 40.0, 90.0), 100.0f, 1e-2f);
    EXPECT_NEAR(at(side, 40.0, 270.0), 280.0f, 1e-2f);
}

TEST(Ies, FactorsMultiplyTheCandelas)
{
    const IesPhotometry lamp =
        parsed("TILT=NONE\n1 -1 2.5 2 1 1 1 0 0 0\n0.8 1 60\n0 90\n0\n10 10");
    EXPECT_NEAR(lamp.peak, 20.0f, 1e-4f);
}

TEST(Ies, TiltIsPassedOver)
{
    const IesPhotometry lamp = parsed("IESNA91\nTILT = INCLUDE\n1\n3\n0 45 90\n1.0 .9 .8\n"
                                      "1 1000 1 2 1 1 2 0 0 0 1 1 60\n0 180\n0\n+5e1 50\n");
    EXPECT_NEAR(lamp.peak, 50.0f, 1e-4f);
}

TEST(Ies, BrokenFilesAreRefusedWithASentence)
{
    const std::string head = "TILT=NONE\n";
    EXPECT_EQ(refusalOfIes("hello"), "lamp.ies: is no IES file: it has no line TILT=");
    EXPECT_EQ(refusalOfIes(""), "lamp.ies: is no IES file: it has no line TILT=");
    EXPECT_THAT(refusalOfIes(head), HasSubstr("ends before the number of lamps"));
    EXPECT_THAT(refusalOfIes(head + "1 1000 1 2 x"),
                HasSubstr("line 2: \"x\" is no number, and should be the number of horizontal"));
    EXPECT_THAT(refusalOfIes(head + "1 1000 1 4000000000 1"), HasSubstr("it must be 1 to 10000"));
    EXPECT_THAT(refusalOfIes(head + "1 1000 1 2.5 1"), HasSubstr("must be a whole number"));
    EXPECT_THAT(refusalOfIes(head + "1 1000 1 2 1 2 1"), HasSubstr("photometry of Type B"));
    EXPECT_THAT(refusalOfIes(head + "1 1000 nan 2 1 1"), HasSubstr("\"nan\" is no number"));
    const std::string whole = head + "1 1000 1 2 1 1 2 0 0 0\n1 1 60\n";
    EXPECT_THAT(refusalOfIes(whole + "90 0\n0\n1 1"),
                HasSubstr("line 4: the list of which a vertical"));
    EXPECT_THAT(refusalOfIes(whole + "0 200\n"), HasSubstr("a vertical angle is 200"));
    EXPECT_THAT(refusalOfIes(whole + "0 90\n45\n1 1"), HasSubstr("go from 45 to 45"));
    EXPECT_THAT(refusalOfIes(whole + "0 90\n0\n1"), HasSubstr("ends before a candela value"));
    EXPECT_THAT(refusalOfIes(whole + "0 90\n0\n0 0"), HasSubstr("gives no light"));
}

// Wherever a good file is cut or one of its bytes is another, it is read or refused.
TEST(Ies, NoDamageIsMoreThanASentence)
{
    const std::string good = iesOf({0, 45, 90}, even, 0.0, 90.0, 15.0);
    const auto readOrRefused = [](const std::string& text) {
        const std::string said = refusalOfIes(text);
        return said.empty() || said.starts_with("lamp.ies: ");
    };
    for (size_t i = 0; i < good.size(); ++i) {
        EXPECT_TRUE(readOrRefused(good.substr(0, i)));
        for (const char c : {'\0', '9', '-', 'e', '\n', '\xff'}) {
            std::string damaged = good;
            damaged[i] = c;
            EXPECT_TRUE(readOrRefused(damaged)) << i;
        }
    }
}

} // namespace relamp
