#pragma once

#include <exception>
#include <string>

/// A sentence for a person about what nobody expected to be thrown: what a library says is for
/// those who know how it is made.
std::string sentenceOf(const std::exception& unexpected);
