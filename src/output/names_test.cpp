#include "relamp/names.h"

#include <gmock/gmock.h>

namespace relamp
{

// A list in another order than its enumeration would give every word another meaning.
TEST(Names, StandForTheirValues)
{
    EXPECT_EQ(named<Solver>("pathtrace"), Solver::pathtrace);
    EXPECT_EQ(named<Solver>("thesis"), Solver::thesis);
    EXPECT_EQ(named<Quality>("draft"), Quality::draft);
    EXPECT_EQ(named<Quality>("high"), Quality::high);
    EXPECT_EQ(named<Transfer>("auto"), Transfer::automatic);
    EXPECT_EQ(named<Transfer>("linear"), Transfer::linear);
    EXPECT_EQ(named<UpAxis>("z"), UpAxis::z);
    EXPECT_EQ(named<Engine>("gpu"), Engine::gpu);
    EXPECT_EQ(named<LightType>("rectangle"), LightType::rectangle);
    EXPECT_EQ(named<LightType>("sun"), LightType::sun);
    EXPECT_EQ(named<View>("agx"), View::agx);
    EXPECT_EQ(named<View>("aces"), View::aces);
    EXPECT_EQ(named<Across>("height"), Across::height);
    EXPECT_STREQ(nameOf(Doubt::backFace), "backFace");
    EXPECT_STREQ(nameOf(Doubt::whiterThanPaper), "whiterThanPaper");
    EXPECT_STREQ(nameOf(Doubt::shared), "shared");
    EXPECT_STREQ(nameOf(Doubt::unproven), "unproven");
    EXPECT_EQ(named<Solver>("Gather"), std::nullopt);
    EXPECT_EQ(namesInWords<UpAxis>(), "y, z");
}

} // namespace relamp
