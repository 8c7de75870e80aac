// `throng`: synthetic crowd datasets from the command line.
#include "cli/shell/program.h"

int main(int argc, char** argv) { return throng::cli::run_throng(argc, argv); }
