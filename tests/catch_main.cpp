// Catch2 2 makes its main() here; version 3 brings one in a library.
#define CATCH_CONFIG_MAIN
#include "tests/catch.h"
