#include "sim/vehicle/flight_world.h"

#include <btBulletDynamicsCommon.h>

#include "base/error.h"
#include "base/geometry/triangulate.h"
#include "sim/vehicle/damage.h"

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kGroundHalfWidthM = 200'000;
constexpr double kGroundHalfDepthM = 50;
constexpr double kFriction = 0.5;

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Labels a body with its kind, for contact handling.
void label(btCollisionObject& body, Obstacle obstacle, int index) {
  body.setUserIndex(static_cast<int>(obstacle));
  body.setUserIndex2(index);
}
Obstacle obstacle_from_body(const btCollisionObject& body) {
  return static_cast<Obstacle>(body.getUserIndex());
}

// One vehicle: its rotors, and its body in Bullet. Stays where it is, since Bullet points to it.
struct Vehicle {
  Vehicle(const Airframe& airframe, double dt_s, const Vector3d& position, double yaw_rad)
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
    Eigen::Vector2d reach_m = Eigen::Vector2d::Zero();
    for (const Rotor& rotor : airframe.rotors) {
      reach_m = reach_m.cwiseMax(rotor.at_m.cwiseAbs());
    }
    reach_m.array() += airframe.propeller_radius_m;
    return {reach_m.x(), reach_m.y(), 0.5 * airframe.height_m};
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

  Vector3d specific_force(double dt_s) const {
    const FlightState now = state();
    Vector3d force = kGravity * Vector3d::UnitZ();
    if (has_moved) force += (now.velocity - velocity_before) / dt_s;
    return now.rotation.transpose() * force;
  }

  Quadcopter quadcopter;
  PerRotor commands;
  Vector3d air_velocity = Vector3d::Zero();
  PerRotor downwash_mps{};
  btBoxShape shape;
  btRigidBody body;
  Vector3d velocity_before = Vector3d::Zero();  ///< at the beginning of the last step
  bool has_moved = false;
};

// Somebody's body. Kinematic: Bullet moves it as commanded and lets vehicles bounce off it.
struct PersonBody {
  explicit PersonBody(btCollisionShape& shape) : body(0, nullptr, &shape) {
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setRestitution(kRestitution);
    body.setFriction(kFriction);
    label(body, Obstacle::person, -1);
  }

  void place() {
    const btTransform transform(btQuaternion::getIdentity(),
                                {person.position.x(), person.position.y(), 0.5 * kPersonHeightM});
    body.setWorldTransform(transform);
  }

  NearPerson person;
  btRigidBody body;
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
              {0, 0, -kGroundHalfDepthM}, Obstacle::ground, -1);
    for (std::size_t i = 0; i < buildings.size(); ++i) {
      add_building(buildings[i], static_cast<int>(i));
    }
  }

  ~Bodies() {
    for (const auto& person : people) world.removeRigidBody(&person->body);
    for (const auto& vehicle : vehicles) world.removeRigidBody(&vehicle->body);
    for (const auto& body : fixed) world.removeRigidBody(body.get());
  }

  // Solid prisms over triangles, since a footprint need not be convex.
  void add_building(const world::Building& building, int index) {
    for (const auto& triangle : geometry::triangulate(building.footprint)) {
      auto prism = std::make_unique<btConvexHullShape>();
      for (const std::size_t corner : triangle) {
        const Eigen::Vector2d& p = building.footprint[corner];
        prism->addPoint({p.x(), p.y(), 0}, false);
        prism->addPoint({p.x(), p.y(), building.height_m}, false);
      }
      prism->recalcLocalAabb();
      add_fixed(std::move(prism), {0, 0, 0}, Obstacle::building, index);
    }
  }

  void add_fixed(std::unique_ptr<btCollisionShape> shape, const btVector3& position,
                 Obstacle obstacle, int index) {
    auto body = std::make_unique<btRigidBody>(0, nullptr, shape.get());
    body->setWorldTransform(btTransform(btQuaternion::getIdentity(), position));
    body->setRestitution(kRestitution);
    body->setFriction(kFriction);
    label(*body, obstacle, index);
    world.addRigidBody(body.get());
    shapes.push_back(std::move(shape));
    fixed.push_back(std::move(body));
  }

  void set_people(std::span<const NearPerson> list) {
    while (people.size() > list.size()) {
      world.removeRigidBody(&people.back()->body);
      people.pop_back();
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const bool is_new = i == people.size();
      if (is_new) people.push_back(std::make_unique<PersonBody>(person_shape));
      PersonBody& person = *people[i];
      const bool moved_in = is_new || person.person.agent != list[i].agent;
      person.person = list[i];
      person.place();
      label(person.body, Obstacle::person, list[i].agent);
      // Else Bullet would take this displacement for motion.
      if (moved_in) person.body.setInterpolationWorldTransform(person.body.getWorldTransform());
      if (is_new) world.addRigidBody(&person.body);
    }
  }

  void move_people() {
    for (const auto& person : people) {
      person->person.position += dt_s * person->person.velocity;
      person->place();
    }
  }

  void note_contacts() {
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      note_contact(manifold, true);
      note_contact(manifold, false);
    }
    contacts.advance(dt_s);
  }

  // The contact of two bodies as the first or the second of them, if that is a vehicle, meets it.
  void note_contact(const btPersistentManifold& manifold, bool first) {
    const btCollisionObject& vehicle = first ? *manifold.getBody0() : *manifold.getBody1();
    const btCollisionObject& other = first ? *manifold.getBody1() : *manifold.getBody0();
    if (obstacle_from_body(vehicle) != Obstacle::drone) return;
    Touch touch;
    touch.vehicle = static_cast<std::size_t>(vehicle.getUserIndex2());
    touch.obstacle = obstacle_from_body(other);
    touch.index = other.getUserIndex2();
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      const double impulse_ns = point.getAppliedImpulse();
      // The normal points from the second body to the first.
      const btVector3 push = (first ? -1.0 : 1.0) * impulse_ns * point.m_normalWorldOnB;
      touch.impulse_ns += impulse_ns;
      touch.push_ns += to_eigen(push);
      const btTransform& pose = vehicle.getWorldTransform();
      const btVector3 at = first ? point.m_positionWorldOnA : point.m_positionWorldOnB;
      const Contact contact{to_eigen(pose.invXform(at)),
                            to_eigen(pose.getBasis().transpose() * -push)};
      const Airframe& airframe = vehicles[touch.vehicle]->quadcopter.airframe();
      if (const auto rotor = propeller_hit(contact, airframe)) touch.rotor_ns[*rotor] += impulse_ns;
    }
    // Bodies that are near but do not push yet do not touch.
    if (touch.impulse_ns <= 0) return;
    touch.speed_mps = (velocity_before(vehicle) - velocity_before(other)).norm();
    contacts.record(touch);
  }

  Vector3d velocity_before(const btCollisionObject& body) const {
    const auto index = static_cast<std::size_t>(body.getUserIndex2());
    switch (obstacle_from_body(body)) {
      case Obstacle::drone:
        return vehicles[index]->velocity_before;
      case Obstacle::person:
        return to_eigen(btRigidBody::upcast(&body)->getLinearVelocity());
      case Obstacle::ground:
      case Obstacle::building:
        break;
    }
    return Vector3d::Zero();
  }

  double dt_s;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> fixed;
  std::vector<std::unique_ptr<Vehicle>> vehicles;
  btCapsuleShapeZ person_shape{kPersonRadiusM, kPersonHeightM - 2 * kPersonRadiusM};
  std::vector<std::unique_ptr<PersonBody>> people;
  ContactLog contacts;
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
  auto vehicle = std::make_unique<Vehicle>(airframe, bodies_->dt_s, position, yaw_rad);
  label(vehicle->body, Obstacle::drone, static_cast<int>(bodies_->vehicles.size()));
  bodies_->world.addRigidBody(&vehicle->body);
  bodies_->vehicles.push_back(std::move(vehicle));
  return bodies_->vehicles.size() - 1;
}

void FlightWorld::command(std::size_t vehicle, const PerRotor& rotor_speeds) {
  bodies_->vehicles[vehicle]->commands = rotor_speeds;
}

void FlightWorld::set_air_velocity(std::size_t vehicle, const Vector3d& velocity) {
  bodies_->vehicles[vehicle]->air_velocity = velocity;
}

void FlightWorld::set_downwash(std::size_t vehicle, const PerRotor& downwash_mps) {
  bodies_->vehicles[vehicle]->downwash_mps = downwash_mps;
}

void FlightWorld::break_rotor(std::size_t vehicle, std::size_t rotor) {
  bodies_->vehicles[vehicle]->quadcopter.break_rotor(rotor);
}

void FlightWorld::set_people(std::span<const NearPerson> people) { bodies_->set_people(people); }

void FlightWorld::step() {
  for (const auto& vehicle : bodies_->vehicles) {
    const FlightState state = vehicle->state();
    const Wrench wrench = vehicle->quadcopter.step(state, vehicle->commands, vehicle->air_velocity,
                                                   vehicle->downwash_mps);
    vehicle->body.applyCentralForce(to_bullet(wrench.force));
    vehicle->body.applyTorque(to_bullet(wrench.torque));
    vehicle->velocity_before = state.velocity;
    vehicle->has_moved = true;
  }
  bodies_->move_people();
  bodies_->world.stepSimulation(bodies_->dt_s, 0);
  bodies_->note_contacts();
}

double FlightWorld::dt_s() const { return bodies_->dt_s; }
std::size_t FlightWorld::size() const { return bodies_->vehicles.size(); }
FlightState FlightWorld::state(std::size_t vehicle) const {
  return bodies_->vehicles[vehicle]->state();
}

Eigen::Quaterniond FlightWorld::orientation(std::size_t vehicle) const {
  const btQuaternion q = bodies_->vehicles[vehicle]->body.getOrientation();
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized();
}

Vector3d FlightWorld::specific_force(std::size_t vehicle) const {
  return bodies_->vehicles[vehicle]->specific_force(bodies_->dt_s);
}

double FlightWorld::thrust_n(std::size_t vehicle) const {
  return bodies_->vehicles[vehicle]->quadcopter.thrust_n();
}

const Airframe& FlightWorld::airframe(std::size_t vehicle) const {
  return bodies_->vehicles[vehicle]->quadcopter.airframe();
}

std::span<const Impact> FlightWorld::impacts() const { return bodies_->contacts.impacts(); }

std::vector<Impact> FlightWorld::unfinished_impacts() const {
  return bodies_->contacts.unfinished();
}

}  // namespace throng::sim
