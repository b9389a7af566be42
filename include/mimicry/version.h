#pragma once

/// The version that a program is compiled with: of semantic versioning's three numbers, the second
/// may change what compiles as long as the first is 0. The C interface has a number of its own,
/// MIMICRY_ABI_VERSION.
#define MIMICRY_VERSION_MAJOR 0
#define MIMICRY_VERSION_MINOR 1
#define MIMICRY_VERSION_PATCH 0
#define MIMICRY_VERSION "0.1.0"
