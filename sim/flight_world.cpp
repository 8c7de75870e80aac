#include "sim/flight_world.h"

#include <btBulletDynamicsCommon.h>

#include <limits>

#include "base/error.h"
#include "world/polygon.h"

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kGroundHalfWidthM = 200'000;
constexpr double kGroundHalfDepthM = 50;
constexpr double kRestitution = 0.3;
constexpr double kFriction = 0.5;
constexpr double kSameContactS = 0.5;

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// One craft: its rotors, and its body in Bullet. Stays where it is, since Bullet points to it.
struct Craft {
  Craft(const Airframe& airframe, double dt_s, const Vector3d& position, double yaw_rad)
      : quadcopter(airframe, dt_s),
        commands(quadcopter.rotor_speeds()),
        shape(half_extents(airframe)),
        body(airframe.mass_kg, nullptr, &shape, to_bullet(airframe.inertia)) {
    body.setWorldTransform(
        btTransform(btQuaternion(btVector3(0, 0, 1), yaw_rad), to_bullet(position)));
    body.setInterpolationWorldTransform(body.getWorldTransform());
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    body.setRestitution(kRestitution);
    body.setFriction(kFriction);
  }

  static btVector3 half_extents(const Airframe& airframe) {
    const double half_width = airframe.arm_m / std::sqrt(2.0) + airframe.propeller_radius_m;
    return {half_width, half_width, 0.5 * airframe.height_m};
  }

  FlightState state() const {
    FlightState state;
    const btMatrix3x3& basis = body.getWorldTransform().getBasis();
    for (int row = 0; row < 3; ++row) state.rotation.row(row) = to_eigen(basis[row]);
    state.position = to_eigen(body.getWorldTransform().getOrigin());
    state.velocity = to_eigen(body.getLinearVelocity());
    state.body_rates = state.rotation.transpose() * to_eigen(body.getAngularVelocity());
    return state;
  }

  Quadcopter quadcopter;
  PerRotor commands;
  Vector3d air_velocity = Vector3d::Zero();
  btBoxShape shape;
  btRigidBody body;
  double speed_before_mps = 0;
  double since_contact_s = std::numeric_limits<double>::infinity();
};

}  // namespace

// The world is declared after what it points to, so that it goes first.
struct FlightWorld::Bodies {
  Bodies(const std::vector<world::Building>& buildings, double step_s)
      : dt_s(step_s),
        dispatcher(&configuration),
        world(&dispatcher, &broadphase, &solver, &configuration) {
    world.setGravity({0, 0, -kGravity});
    world.setForceUpdateAllAabbs(false);
    add_fixed(std::make_unique<btBoxShape>(
                  btVector3(kGroundHalfWidthM, kGroundHalfWidthM, kGroundHalfDepthM)),
              {0, 0, -kGroundHalfDepthM});
    for (const world::Building& building : buildings) add_building(building);
  }

  ~Bodies() {
    for (const auto& craft : crafts) world.removeRigidBody(&craft->body);
    for (const auto& body : fixed) world.removeRigidBody(body.get());
  }

  // Solid prisms over triangles, since a footprint need not be convex.
  void add_building(const world::Building& building) {
    for (const auto& triangle : world::triangulate(building.footprint)) {
      auto prism = std::make_unique<btConvexHullShape>();
      for (const std::size_t corner : triangle) {
        const Eigen::Vector2d& p = building.footprint[corner];
        prism->addPoint({p.x(), p.y(), 0}, false);
        prism->addPoint({p.x(), p.y(), building.height_m}, false);
      }
      prism->recalcLocalAabb();
      add_fixed(std::move(prism), {0, 0, 0});
    }
  }

  void add_fixed(std::unique_ptr<btCollisionShape> shape, const btVector3& position) {
    auto body = std::make_unique<btRigidBody>(0, nullptr, shape.get());
    body->setWorldTransform(btTransform(btQuaternion::getIdentity(), position));
    body->setRestitution(kRestitution);
    body->setFriction(kFriction);
    body->setUserIndex(-1);
    world.addRigidBody(body.get());
    shapes.push_back(std::move(shape));
    fixed.push_back(std::move(body));
  }

  void note_contacts() {
    impacts.clear();
    for (const auto& craft : crafts) craft->since_contact_s += dt_s;
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      for (int point = 0; point < manifold.getNumContacts(); ++point) {
        // Points that are near but do not push yet are no contact.
        if (manifold.getContactPoint(point).getAppliedImpulse() <= 0) continue;
        note_contact(manifold.getBody0()->getUserIndex());
        note_contact(manifold.getBody1()->getUserIndex());
        break;
      }
    }
  }

  void note_contact(int index) {
    if (index < 0) return;
    Craft& craft = *crafts[static_cast<std::size_t>(index)];
    if (craft.since_contact_s > kSameContactS) {
      impacts.push_back({static_cast<std::size_t>(index), craft.speed_before_mps});
    }
    craft.since_contact_s = 0;
  }

  double dt_s;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> fixed;
  std::vector<std::unique_ptr<Craft>> crafts;
  std::vector<Impact> impacts;
  btDiscreteDynamicsWorld world;
};

FlightWorld::FlightWorld(const std::vector<world::Building>& buildings, double dt_s)
    : bodies_(std::make_unique<Bodies>(buildings, dt_s)) {
  check(dt_s > 0, "time goes forward");
}
FlightWorld::~FlightWorld() = default;
FlightWorld::FlightWorld(FlightWorld&&) noexcept = default;
FlightWorld& FlightWorld::operator=(FlightWorld&&) noexcept = default;

std::size_t FlightWorld::add(const Airframe& airframe, const Vector3d& position, double yaw_rad) {
  auto craft = std::make_unique<Craft>(airframe, bodies_->dt_s, position, yaw_rad);
  craft->body.setUserIndex(static_cast<int>(bodies_->crafts.size()));
  bodies_->world.addRigidBody(&craft->body);
  bodies_->crafts.push_back(std::move(craft));
  return bodies_->crafts.size() - 1;
}

void FlightWorld::command(std::size_t craft, const PerRotor& rotor_speeds) {
  bodies_->crafts[craft]->commands = rotor_speeds;
}

void FlightWorld::set_air_velocity(std::size_t craft, const Vector3d& velocity) {
  bodies_->crafts[craft]->air_velocity = velocity;
}

void FlightWorld::step() {
  for (const auto& craft : bodies_->crafts) {
    const FlightState state = craft->state();
    const Wrench wrench = craft->quadcopter.step(state, craft->commands, craft->air_velocity);
    craft->body.applyCentralForce(to_bullet(wrench.force));
    craft->body.applyTorque(to_bullet(wrench.torque));
    craft->speed_before_mps = state.velocity.norm();
  }
  bodies_->world.stepSimulation(bodies_->dt_s, 0);
  bodies_->note_contacts();
}

double FlightWorld::dt_s() const { return bodies_->dt_s; }
std::size_t FlightWorld::size() const { return bodies_->crafts.size(); }
FlightState FlightWorld::state(std::size_t craft) const { return bodies_->crafts[craft]->state(); }

Eigen::Quaterniond FlightWorld::orientation(std::size_t craft) const {
  const btQuaternion q = bodies_->crafts[craft]->body.getOrientation();
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized();
}

std::span<const Impact> FlightWorld::impacts() const { return bodies_->impacts; }

}  // namespace throng::sim
