#pragma once

#include "light_document.h"

#include "relamp/delight.h"
#include "relamp/view.h"

#include <cstddef>

/// The solver and its parameters, as far as the viewer has them.
struct SolverParameters
{
    relamp::Solver solver = relamp::Solver::gather;
    relamp::GatherOptions gather;
    relamp::PathtraceOptions pathtrace;
    relamp::ThesisOptions thesis;
    relamp::AlbedoOptions albedo;

    bool operator==(const SolverParameters& other) const = default;
    [[nodiscard]] relamp::DelightOptions options() const;
    /// Places in a room that is open no more.
    void forgetPlaces();
};

/// What a person may change and take back.
struct Edit
{
    LightDocument light;  // how it shall shine now
    ScannedItems scanned; // how it was on the day of the scan
    relamp::ViewOptions view;
    SolverParameters parameters;

    bool operator==(const Edit& other) const;
};

struct Selection
{
    enum class Kind { none, lamp, fixture };
    Kind kind = Kind::none;
    size_t index = 0;

    bool operator==(const Selection&) const = default;
};
