// Low plants of leaf cards: bushes, and planters with plants in them.
#pragma once

#include <Eigen/Core>

#include "render/props/prop_builder.h"

namespace throng::render {

/// The leaves on a rounded body; lengths in m.
struct LeafBody {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d radii = Eigen::Vector3d::Ones();
  LeafSprite sprite = LeafSprite::broad;
  int cards = 40;
  double card_m = 0.2;  ///< half the side of a card
  Eigen::Vector3d paint = Eigen::Vector3d::Zero();
};

/// Adds cards over the surface of a body, darker toward the ground. None reaches below it.
void add_leaf_body(PropBuilder& builder, const LeafBody& body);

/// Adds a bush, whose look is clipped, loose or flowering: 0.7 to 1.5 m high.
void make_bush(PropBuilder& builder);

/// Adds a trough of stone or wood with a clipped hedge, grasses or flowers.
void make_planter(PropBuilder& builder);

}  // namespace throng::render
