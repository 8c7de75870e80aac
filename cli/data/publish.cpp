// throng publish: a finished dataset as objects of a bucket.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "cli/shell/commands.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress_bar.h"
#include "jobs/bucket/publish.h"
#include "spec/bucket/address.h"

namespace throng::cli {

void add_publish(CLI::App& app) {
  struct Arguments {
    std::string dataset;
    std::string address;
  };
  auto* command =
      app.add_subcommand("publish", "Bring a finished dataset to an S3-compatible object store");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("dataset", arguments->dataset, "The dataset's folder")->required();
  command->add_option("address", arguments->address, "s3://BUCKET/PREFIX")->required();
  command->footer(
      "Credentials, region and endpoint come from the environment or files, as the AWS command "
      "line "
      "reads them (docs/publishing.md). The same command goes on after an interruption.");
  command->callback([arguments] {
    const bucket::Address address = bucket::parse_address(arguments->address, "address", "");
    bucket::Published published;
    {
      const Interrupt interrupt;
      ProgressBar bar("publishing");
      published = bucket::publish_dataset(
          arguments->dataset, address,
          [&](std::int64_t done_bytes, std::int64_t total_bytes) {
            bar.show(static_cast<double>(done_bytes) / static_cast<double>(total_bytes),
                     format_megabytes(done_bytes, total_bytes));
          },
          interrupt.token());
    }
    fmt::print("{}: {} objects, {} bytes\n", address.text(), published.objects, published.bytes);
  });
}

}  // namespace throng::cli
