# Makes a job for training of a shipped demo: jq -f examples/training_set.jq scenarios/bridge/demo.job.json > bridge.job.json
# Each run has another height, direction, hour, weather and crowd.
.runs = 6
| .name = "training, \(.scenario)"
| .capture = {rate_hz: 0.25, from_s: 0, to_s: 24}
| .drones |= [.[0]]
| .drones[0].camera += {
    width: 480, height: 270, hfov_deg: 75,
    pitch_deg: {uniform: [-65, -30]},
    yaw_deg: {uniform: [.drones[0].camera.yaw_deg - 25, .drones[0].camera.yaw_deg + 25]}
  }
| .randomize = {"drones.0.start.2": {uniform: [10, 24]}}
| .environment = {time_of_day: {uniform: ["07:00", "19:00"]}, weather: {choice: ["clear", "clear", "overcast", "rain"]}}
| .outputs = {image: {format: "jpeg", quality: 95}, annotations: ["coco"], splits: {train: 0.75, val: 0.25}}
