#pragma once

/// Marks what the shared library exports; everything else stays inside it.
#define RELAMP_API __attribute__((visibility("default")))
