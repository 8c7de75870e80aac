// `throng`: synthetic crowd datasets from the command line.
#include "cli/more/more_commands.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  return throng::cli::run_throng(argc, argv, throng::cli::more_commands());
}
