// `throng_first`: `throng` without the commands of cli/more, which the first image does not need
// (scripts/demo.sh).
#include "cli/program.h"

int main(int argc, char** argv) { return throng::cli::run_throng(argc, argv, {}); }
