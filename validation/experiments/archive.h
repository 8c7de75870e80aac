// Experiments of the Pedestrian Dynamics Data Archive of Forschungszentrum Jülich
// (https://doi.org/10.34735/ped.da), recognized by the names of their files.
#pragma once

#include <filesystem>
#include <optional>

#include "spec/crowd/experiment.h"

namespace throng::validation {

/// Returns the experiment of a file whose name (without .gz and suffix) is one of:
/// - uo-B1-B-B2: Hermes 2009, a corridor of B cm with an entrance of B1 and an exit of B2 cm
///   (Zhang, Klingsch, Schadschneider and Seyfried 2011, J. Stat. Mech. P06004);
/// - NNN_c_WW_h-, h0, h+ (q for c): opening of 0.5 m at the end of a corridor of WW dm (Adrian,
///   Seyfried and Sieben 2020, J. R. Soc. Interface 17: 20190871);
/// - bi_corr_W_..., uni_corr_W_...: corridors of W cm, both directions and one (Cao et al. 2017,
///   J. Stat. Mech. 033402);
/// - single_file_nN_..., NN_nN: N people in single file in a closed corridor (Seyfried et al.
/// 2010). Not the file, but its name is looked at.
std::optional<Experiment> archived_experiment(const std::filesystem::path& file);

/// The diagram of the Hermes corridors: speeds of people at densities of 0.4 to 3.4 1/m^2, means
/// over the steady states.
Experiment hermes_diagram();

}  // namespace throng::validation
