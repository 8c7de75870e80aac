"""Damages to a dataset, one at a time, each with the manifest's sizes and hashes put right: what `throng validate`
should find without the manifest. See docs/formats.md, and test_validate_damages.py, which runs them.

usage: python3 tests/cli/damages THRONG DATASET [NAME...]    prints a table; DATASET has all annotations and at least two
runs, two cameras and five frames; damages of formats/ need `mot`, `yolo-detect`, `kitti`, `voc` and `table` there.

All damages by the module that holds them; names on the command line have blanks for underscores."""
from . import (
    cameras,
    counts,
    difficulty,
    exits,
    exports,
    fields,
    hazards,
    heads,
    identities,
    images,
    lenses,
    motion,
    pixels,
    poses,
    runs,
    shapes,
    trajectories,
    vehicles,
)

TABLE = {
    motion: """
        backward_flow_is_forward_flow backward_flow_reversed backward_flow_of_people_zero
        backward_flow_of_the_first_frame occlusion_all_visible occlusion_inverted occlusion_outside_is_hidden
        occlusion_of_the_frame_before occlusion_of_unknown_values scene_flow_reversed scene_flow_axes_exchanged
        scene_flow_in_centimeters scene_flow_a_tenth_less scene_flow_of_one_person_zero scene_flow_of_still_pixels_5_cm
        scene_flow_of_the_last_frame""",
    trajectories: """
        trajectories_10_cm_off trajectories_one_frame_late trajectories_without_somebody_seen
        trajectories_of_two_people_exchanged trajectory_headings_from_north trajectory_states_exchanged
        trajectory_of_somebody_leaps events_30_m_off events_of_the_next_frame events_20_s_late""",
    images: """
        picture_black picture_mirrored picture_upside_down all_pictures_mirrored pictures_of_two_cameras_exchanged
        pictures_of_two_frames_exchanged picture_of_the_next_frame picture_of_the_other_run
        picture_2_px_to_the_right all_pictures_3_px_down red_and_blue_exchanged
        red_and_blue_exchanged_in_all_pictures picture_without_color picture_negative picture_blurred
        picture_of_lower_quality preview_of_another_frame previews_of_two_cameras_exchanged picture_half_as_bright
        all_pictures_20_percent_darker picture_without_somebody pictures_of_a_camera_exchanged_between_runs
        pictures_of_a_camera_one_frame_late""",
    poses: """
        left_and_right_keypoints_exchanged left_and_right_keypoints_of_one_person_exchanged
        left_and_right_arms_of_one_person_exchanged keypoints_exchanged_in_the_picture_only
        elbows_and_wrists_of_one_person_exchanged eyes_and_ears_exchanged visible_keypoints_called_hidden
        hidden_keypoints_called_visible velocities_reversed velocity_of_one_person_reversed
        velocities_5_percent_too_high velocities_of_one_frame_turned_by_90_degrees velocity_axes_exchanged
        velocities_of_one_frame_zero headings_turned_by_90_degrees headings_from_north
        heading_of_one_person_reversed headings_of_one_frame_40_degrees_off headings_in_degrees positions_30_cm_off
        position_of_one_person_1_m_off position_axes_exchanged positions_of_the_frame_before
        keypoint_visibility_inverted keypoints_2_px_to_the_right all_places_50_cm_higher
        positions_at_the_middle_of_the_body places_in_a_run_30_cm_off places_of_one_person_30_cm_off
        velocities_one_frame_late velocities_in_km_per_h headings_are_of_velocity_reversed_for_those_who_stand
        joints_left_and_right_exchanged_in_the_image_only joints_2_px_to_the_right
        self_hidden_joints_called_hidden all_joints_visible gaze_backward
        turns_of_heads_and_gazes_backward toes_are_heels bone_turns_of_length_2 joints_left_out""",
    shapes: """
        box_3d_30_cm_off boxes_3d_20_percent_too_large box_3d_sizes_exchanged head_of_one_person_off
        heads_at_the_feet amodal_box_4_px_off amodal_boxes_are_visible_boxes amodal_masks_moved
        amodal_mask_of_one_person_moved amodal_mask_is_visible_mask amodal_mask_is_its_box hidden_people_left_out
        hidden_people_of_one_picture_left_out hidden_boxes_moved hidden_people_exchanged boxes_2_px_to_the_right
        amodal_boxes_2_px_down_everywhere masks_and_boxes_of_one_person_3_px_off
        masks_and_boxes_of_all_people_2_px_off masks_of_two_people_exchanged mask_one_pixel_thinner
        visibility_inverted truncation_left_out truncation_doubled heads_3_px_higher""",
    identities: """
        somebody_erased two_people_exchanged_in_one_frame poses_of_two_people_exchanged
        attributes_of_two_people_exchanged attributes_of_all_people_moved_by_one colors_of_clothes_exchanged
        walking_people_stand everybody_carries unknown_action
        two_motions_at_once actions_a_second_late together_with_a_stranger
        garment_called_another_color garment_in_another_slot garment_left_out
        colors_as_bgr sex_of_one_person stature_of_one_person_20_cm_less state_of_walkers_waiting
        state_of_one_person_running exits_of_people_exchanged labels_of_the_frame_before ids_permuted_after_a_frame
        ids_of_two_people_exchanged_after_a_frame ids_of_two_people_exchanged_in_one_camera
        one_person_removed_everywhere everybody_in_the_background_removed annotation_twice top_colors_inverted
        top_color_of_the_largest_person_green groups_moved_by_one ages_ten_years_older statures_in_centimeters
        behaviors_of_people_exchanged categories_exchanged runs_of_images_exchanged runs_of_tracks_exchanged
        carried_items_left_out""",
    cameras: """
        flight_moved_by_5_m flight_of_one_picture_moved_by_20_cm camera_and_flight_moved_by_5_m
        camera_turned_by_half_a_degree camera_of_the_frame_before focal_length_1_percent_more
        flight_velocity_axes_exchanged flight_orientation_inverted gimbal_yaw_with_the_other_sign gimbal_in_radians
        gyro_and_accelerometer_of_pictures_exchanged sensor_columns_vx_and_vy_exchanged
        sensor_columns_gyro_y_and_z_exchanged sensor_columns_gps_and_truth_exchanged sensor_rows_late_by_one
        sensor_readings_late_by_10_rows gyro_in_degrees sensors_of_the_other_drone sensors_of_the_other_run
        one_row_of_sensors_spoilt sun_on_the_other_side weather_of_one_run""",
    lenses: """
        focal_length_3_percent_more_in_calibrations_too focal_length_3_percent_more_along_x principal_point_3_px_off
        calibration_file_of_another_focal_length calibration_files_of_two_cameras_exchanged
        distortion_with_the_other_sign lens_called_pinhole cameras_turned_by_1_degree
        camera_of_one_picture_turned_by_1_degree times_one_frame_late times_and_capture_half_a_second_late
        capture_rate_doubled weather_rain_everywhere time_of_day_three_hours_later sensor_record_says_noise
        gyro_without_noise accelerometer_5_percent_more magnetometer_axes_exchanged gps_30_m_off
        pressure_in_hectopascal energy_of_the_battery_halved seeds_of_runs_exchanged
        gimbal_pitch_5_degrees_off_in_the_job wind_of_the_job""",
    pixels: """
        depth_of_buildings_5_percent_more depth_of_buildings_4_percent_less depth_of_buildings_in_one_picture
        depth_of_one_building depth_of_props depth_of_one_person_1_m_more depth_1_percent_more
        depth_of_the_frame_before depth_along_the_ray normals_flipped normals_of_buildings_flipped_in_one_picture
        normals_of_people_flipped normal_axes_exchanged normals_turned_by_20_degrees normals_in_camera_axes
        normals_of_the_frame_before flow_reversed flow_axes_exchanged flow_of_still_pixels_zero flow_of_people_zero
        flow_of_one_person_reversed flow_5_percent_more flow_of_the_frame_before flow_half_unknown
        flow_of_the_last_frame parts_left_and_right_exchanged parts_of_one_person_left_and_right_exchanged
        parts_heads_and_torsos_exchanged parts_arms_and_legs_exchanged parts_all_torso
        ids_of_two_buildings_exchanged building_called_prop ground_called_building depth_2_percent_more_everywhere
        depth_of_people_2_percent_more depth_mirrored depth_in_millimeters depth_of_the_other_camera
        depth_unknown_in_a_patch normals_mirrored normals_all_up flow_in_half_units flow_2_px_off
        flow_of_people_1_px_off_everywhere ids_of_people_one_more instances_2_px_off parts_2_px_off
        parts_of_two_frames_exchanged semantic_people_called_umbrellas semantic_mirrored
        semantic_props_called_buildings""",
    fields: """
        density_map_2_px_off density_map_of_another_picture density_map_without_somebody
        fields_turned_by_180_degrees field_mirrored field_velocities_reversed field_velocity_axes_exchanged
        field_one_cell_off field_origin_1_m_off fields_one_frame_late fields_of_the_other_run field_voronoi_doubled
        field_planes_of_density_exchanged density_map_mirrored density_maps_10_percent_more
        density_maps_and_counts_doubled density_map_with_nan field_with_nan field_with_infinity
        fields_10_percent_more field_velocities_in_km_per_h field_upside_down fields_with_twice_the_cells
        field_people_one_more""",
    exits: """
        exits_shifted_by_one_frame exits_exchanged exits_of_the_other_run clogging_index_inverted
        clogging_index_inverted_where_people_wait flow_of_exits_doubled states_of_exits_idle
        density_of_exits_per_10_m2 people_at_exits_too_few door_3_px_off_in_one_picture doors_and_zones_exchanged
        zones_of_two_exits_exchanged metrics_of_two_runs_exchanged metrics_with_another_number_of_people
        metrics_time_in_state_halved metrics_greatest_density_halved escape_curve_reversed crossings_one_more
        crossings_one_more_from_a_frame_on crossings_in_and_out_exchanged queues_one_more people_at_exits_one_more
        predicted_waits_halved predicted_waits_doubled pressure_of_exits_doubled exits_with_nan door_of_one_exit_3_px_off_in_all_pictures
        mean_escape_time_10_s_more escape_percentiles_20_percent_less not_escaped_one_less
        one_more_left_by_an_exit net_out_one_more
        shares_of_exits_moved_by_one metrics_in_one_place_only drones_of_metrics_flew_farther exposure_doubled""",
    exports: """
        formats_mot_ids_exchanged formats_yolo_box_moved formats_kitti_rotation_reversed formats_table_column
        formats_yolo_class_one_more formats_visdrone_category_pedestrians_called_people
        formats_visdrone_occlusion_inverted formats_mot_boxes_2_px_off formats_mot_frames_from_zero
        formats_coco_box_moved""",
    difficulty: """
        contrasts_doubled edge_contrast_of_one_person_zero difficulties_of_two_people_exchanged blur_of_10_px
        visible_keypoints_one_more difficulty_left_out occluders_left_out occluders_are_others
        occluder_shares_of_the_visible_area lookalikes_left_out lookalike_of_other_colors
        lookalike_of_oneself lookalike_of_another_image""",
    counts: """
        count_of_visible_people_one_more counts_of_the_other_run people_inside_one_more
        somebody_enters_who_was_inside zones_of_another_place lines_in_the_other_direction coarse_field_mirrored
        coarse_fields_10_percent_more""",
    heads: """
        head_boxes_moved_by_their_width head_box_twice_as_large head_boxes_are_those_of_the_bodies
        head_boxes_of_a_tenth head_box_left_out head_visibility_inverted head_visibility_is_the_bodys""",
    runs: """
        sensor_columns_renamed one_sensor_column_renamed sensor_names_exchanged sensor_rows_left_out
        one_sensor_row_left_out sensor_rows_from_the_middle_on sensor_rows_end_early exit_columns_renamed
        keypoint_names_reversed skeleton_from_zero skeleton_without_a_limb joint_names_exchanged bone_name_left_out
        category_left_out notices_left_out one_notice_left_out escapes_left_out events_left_out
        notices_half_a_second_early escapes_called_notices notices_of_others somebody_departs_twice
        event_of_unknown_type unseen_people_2_m_off unseen_people_mirrored somebody_unseen_left_out
        somebody_unseen_absent_for_a_frame unseen_people_in_other_frames unseen_people_look_back
        unseen_people_in_other_states one_hidden_person_left_out everybody_male parts_all_head
        semantic_roofs_and_facades_exchanged semantic_doors_and_facades_exchanged
        semantic_road_and_pavement_exchanged_in_one_image""",
    hazards: """
        hazard_left_out hazard_3_m_off hazard_areas_10_px_off hazards_twice_as_large hazard_of_another_kind hazards_of_another_kind
        hazard_begins_later danger_from_the_middle danger_left_out time_in_danger_is_a_minute
        opacity_left_out opacity_halved opacity_of_fire_and_smoke_exchanged
        opacity_of_smoke_called_gas opacity_of_fire_upside_down opacity_before_the_fire""",
    vehicles: """
        vehicle_left_out vehicles_of_one_image_left_out vehicle_count_one_more vehicle_box_2_px_wider
        vehicle_category_exchanged vehicle_track_and_category_exchanged vehicle_tracks_exchanged_in_one_image
        vehicle_mask_moved vehicle_box_3d_1_m_off vehicle_boxes_3d_turned_by_90_degrees vehicle_boxes_3d_twice_as_high
        vehicle_in_motion vehicle_place_jumps vehicle_visibility_is_a_half vehicle_amodal_box_is_5_px_off
        semantic_land_called_pavement semantic_walls_called_facades semantic_road_and_pavement_exchanged semantic_grass_and_road_exchanged""",
}
#: Damages that need a dataset with cars, or one in which a disaster has begun.
OF_VEHICLES = {name.replace("_", " ") for name in TABLE[vehicles].split()}
#: Of what is said twice of a whole run.
OF_RUNS = {name.replace("_", " ") for name in TABLE[runs].split()}
OF_HAZARDS = {name.replace("_", " ") for name in TABLE[hazards].split()}
KINDS = {name.replace("_", " "): getattr(module, name) for module, names in TABLE.items() for name in names.split()}

for _module, _names in TABLE.items():
    _marked = {name for name, value in vars(_module).items() if getattr(value, "is_damage", False)}
    assert _marked == set(_names.split()), f"the table lacks or invents {_marked ^ set(_names.split())}"
