// SPDX-License-Identifier: Apache-2.0
#include "services/common/px4_releases.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace foretrack {
namespace {

// Fields as PX4's definitions have them: tests/idl/px4_definitions.py compares.
struct Definition {
  std::string_view message;
  int first, last;  // minor numbers of the releases
  int version;
  std::string_view fields;
};
constexpr auto kDefinitions = std::to_array<Definition>({
    {"VehicleStatus", 15, 15, 0,
     "uint64 timestamp, uint64 armed_time, uint64 takeoff_time, uint8 arming_state, "
     "uint8 latest_arming_reason, uint8 latest_disarming_reason, uint64 nav_state_timestamp, "
     "uint8 nav_state_user_intention, uint8 nav_state, uint8 executor_in_charge, "
     "uint32 valid_nav_states_mask, uint32 can_set_nav_states_mask, "
     "uint16 failure_detector_status, uint8 hil_state, uint8 vehicle_type, bool failsafe, "
     "bool failsafe_and_user_took_over, uint8 failsafe_defer_state, bool gcs_connection_lost, "
     "uint8 gcs_connection_lost_counter, bool high_latency_data_link_lost, bool is_vtol, "
     "bool is_vtol_tailsitter, bool in_transition_mode, bool in_transition_to_fw, "
     "uint8 system_type, uint8 system_id, uint8 component_id, bool safety_button_available, "
     "bool safety_off, bool power_input_valid, bool usb_connected, "
     "bool open_drone_id_system_present, bool open_drone_id_system_healthy, "
     "bool parachute_system_present, bool parachute_system_healthy, "
     "bool avoidance_system_required, bool avoidance_system_valid, "
     "bool rc_calibration_in_progress, bool calibration_enabled, bool pre_flight_checks_pass"},
    {"VehicleStatus", 16, 17, 1,
     "uint64 timestamp, uint64 armed_time, uint64 takeoff_time, uint8 arming_state, "
     "uint8 latest_arming_reason, uint8 latest_disarming_reason, uint64 nav_state_timestamp, "
     "uint8 nav_state_user_intention, uint8 nav_state, uint8 executor_in_charge, "
     "uint32 valid_nav_states_mask, uint32 can_set_nav_states_mask, "
     "uint16 failure_detector_status, uint8 hil_state, uint8 vehicle_type, bool failsafe, "
     "bool failsafe_and_user_took_over, uint8 failsafe_defer_state, bool gcs_connection_lost, "
     "uint8 gcs_connection_lost_counter, bool high_latency_data_link_lost, bool is_vtol, "
     "bool is_vtol_tailsitter, bool in_transition_mode, bool in_transition_to_fw, "
     "uint8 system_type, uint8 system_id, uint8 component_id, bool safety_button_available, "
     "bool safety_off, bool power_input_valid, bool usb_connected, "
     "bool open_drone_id_system_present, bool open_drone_id_system_healthy, "
     "bool parachute_system_present, bool parachute_system_healthy, "
     "bool rc_calibration_in_progress, bool calibration_enabled, bool pre_flight_checks_pass"},
    {"VehicleStatus", 18, 18, 4,
     "uint64 timestamp, uint64 armed_time, uint64 takeoff_time, uint8 arming_state, "
     "uint8 latest_arming_reason, uint8 latest_disarming_reason, uint64 nav_state_timestamp, "
     "uint8 nav_state_user_intention, uint8 nav_state, uint8 executor_in_charge, "
     "uint8 nav_state_display, bool accepts_offboard_setpoints, uint32 valid_nav_states_mask, "
     "uint32 can_set_nav_states_mask, uint8 hil_state, uint8 vehicle_type, bool failsafe, "
     "bool failsafe_and_user_took_over, uint8 failsafe_defer_state, bool gcs_connection_lost, "
     "uint8 gcs_connection_lost_counter, bool high_latency_data_link_lost, bool is_vtol, "
     "bool is_vtol_tailsitter, bool in_transition_mode, bool in_transition_to_fw, "
     "uint8 system_type, uint8 system_id, uint8 component_id, bool safety_button_available, "
     "bool safety_off, bool power_input_valid, bool usb_connected, "
     "bool open_drone_id_system_present, bool open_drone_id_system_healthy, "
     "bool parachute_system_present, bool parachute_system_healthy, "
     "bool traffic_avoidance_system_present, bool rc_calibration_in_progress, "
     "bool calibration_enabled, bool pre_flight_checks_pass"},
    {"BatteryStatus", 15, 15, 0,
     "uint64 timestamp, bool connected, float32 voltage_v, float32 voltage_filtered_v, "
     "float32 current_a, float32 current_filtered_a, float32 current_average_a, "
     "float32 discharged_mah, float32 remaining, float32 scale, float32 time_remaining_s, "
     "float32 temperature, uint8 cell_count, uint8 source, uint8 priority, uint16 capacity, "
     "uint16 cycle_count, uint16 average_time_to_empty, uint16 serial_number, "
     "uint16 manufacture_date, uint16 state_of_health, uint16 max_error, uint8 id, "
     "uint16 interface_error, float32[14] voltage_cell_v, float32 max_cell_voltage_delta, "
     "bool is_powering_off, bool is_required, uint16 faults, uint32 custom_faults, "
     "uint8 warning, uint8 mode, float32 average_power, float32 available_energy, "
     "float32 full_charge_capacity_wh, float32 remaining_capacity_wh, "
     "float32 design_capacity, uint16 average_time_to_full, uint16 over_discharge_count, "
     "float32 nominal_voltage"},
    {"BatteryStatus", 16, 16, 0,
     "uint64 timestamp, bool connected, float32 voltage_v, float32 current_a, "
     "float32 current_average_a, float32 discharged_mah, float32 remaining, float32 scale, "
     "float32 time_remaining_s, float32 temperature, uint8 cell_count, uint8 source, "
     "uint8 priority, uint16 capacity, uint16 cycle_count, uint16 average_time_to_empty, "
     "uint16 serial_number, uint16 manufacture_date, uint16 state_of_health, "
     "uint16 max_error, uint8 id, uint16 interface_error, float32[14] voltage_cell_v, "
     "float32 max_cell_voltage_delta, bool is_powering_off, bool is_required, uint16 faults, "
     "uint8 warning, float32 full_charge_capacity_wh, float32 remaining_capacity_wh, "
     "uint16 over_discharge_count, float32 nominal_voltage, "
     "float32 internal_resistance_estimate, float32 ocv_estimate, "
     "float32 ocv_estimate_filtered, float32 volt_based_soc_estimate, "
     "float32 voltage_prediction, float32 prediction_error, float32 estimation_covariance_norm"},
    {"BatteryStatus", 17, 18, 1,
     "uint64 timestamp, bool connected, float32 voltage_v, float32 current_a, "
     "float32 current_average_a, float32 discharged_mah, float32 remaining, float32 scale, "
     "float32 time_remaining_s, float32 temperature, uint8 cell_count, uint8 source, "
     "uint8 priority, uint16 capacity, uint16 cycle_count, uint16 average_time_to_empty, "
     "uint16 manufacture_date, uint16 state_of_health, uint16 max_error, uint8 id, "
     "uint16 interface_error, float32[14] voltage_cell_v, float32 max_cell_voltage_delta, "
     "bool is_powering_off, bool is_required, uint8 warning, uint16 faults, "
     "float32 full_charge_capacity_wh, float32 remaining_capacity_wh, "
     "uint16 over_discharge_count, float32 nominal_voltage, "
     "float32 internal_resistance_estimate, float32 ocv_estimate, "
     "float32 ocv_estimate_filtered, float32 volt_based_soc_estimate, "
     "float32 voltage_prediction, float32 prediction_error, float32 estimation_covariance_norm"},
    {"VehicleLocalPosition", 15, 15, 0,
     "uint64 timestamp, uint64 timestamp_sample, bool xy_valid, bool z_valid, "
     "bool v_xy_valid, bool v_z_valid, float32 x, float32 y, float32 z, float32[2] delta_xy, "
     "uint8 xy_reset_counter, float32 delta_z, uint8 z_reset_counter, float32 vx, float32 vy, "
     "float32 vz, float32 z_deriv, float32[2] delta_vxy, uint8 vxy_reset_counter, "
     "float32 delta_vz, uint8 vz_reset_counter, float32 ax, float32 ay, float32 az, "
     "float32 heading, float32 heading_var, float32 unaided_heading, float32 delta_heading, "
     "uint8 heading_reset_counter, bool heading_good_for_control, float32 tilt_var, "
     "bool xy_global, bool z_global, uint64 ref_timestamp, float64 ref_lat, float64 ref_lon, "
     "float32 ref_alt, float32 dist_bottom, bool dist_bottom_valid, "
     "uint8 dist_bottom_sensor_bitfield, float32 eph, float32 epv, float32 evh, float32 evv, "
     "bool dead_reckoning, float32 vxy_max, float32 vz_max, float32 hagl_min, float32 hagl_max"},
    {"VehicleLocalPosition", 16, 16, 0,
     "uint64 timestamp, uint64 timestamp_sample, bool xy_valid, bool z_valid, "
     "bool v_xy_valid, bool v_z_valid, float32 x, float32 y, float32 z, float32[2] delta_xy, "
     "uint8 xy_reset_counter, float32 delta_z, uint8 z_reset_counter, float32 vx, float32 vy, "
     "float32 vz, float32 z_deriv, float32[2] delta_vxy, uint8 vxy_reset_counter, "
     "float32 delta_vz, uint8 vz_reset_counter, float32 ax, float32 ay, float32 az, "
     "float32 heading, float32 heading_var, float32 unaided_heading, float32 delta_heading, "
     "uint8 heading_reset_counter, bool heading_good_for_control, float32 tilt_var, "
     "bool xy_global, bool z_global, uint64 ref_timestamp, float64 ref_lat, float64 ref_lon, "
     "float32 ref_alt, bool dist_bottom_valid, float32 dist_bottom, float32 dist_bottom_var, "
     "float32 delta_dist_bottom, uint8 dist_bottom_reset_counter, "
     "uint8 dist_bottom_sensor_bitfield, float32 eph, float32 epv, float32 evh, float32 evv, "
     "bool dead_reckoning, float32 vxy_max, float32 vz_max, float32 hagl_min, "
     "float32 hagl_max_z, float32 hagl_max_xy"},
    {"VehicleLocalPosition", 17, 18, 1,
     "uint64 timestamp, uint64 timestamp_sample, bool xy_valid, bool z_valid, "
     "bool v_xy_valid, bool v_z_valid, float32 x, float32 y, float32 z, float32[2] delta_xy, "
     "uint8 xy_reset_counter, float32 delta_z, uint8 z_reset_counter, float32 vx, float32 vy, "
     "float32 vz, float32 z_deriv, float32[2] delta_vxy, uint8 vxy_reset_counter, "
     "float32 delta_vz, uint8 vz_reset_counter, float32 ax, float32 ay, float32 az, "
     "float32 heading, float32 heading_var, float32 unaided_heading, float32 delta_heading, "
     "uint8 heading_reset_counter, bool heading_good_for_control, float32 tilt_var, "
     "bool xy_global, bool z_global, uint64 ref_timestamp, float64 ref_lat, float64 ref_lon, "
     "float32 ref_alt, bool dist_bottom_valid, float32 dist_bottom, float32 dist_bottom_var, "
     "float32 delta_dist_bottom, uint8 dist_bottom_reset_counter, "
     "uint8 dist_bottom_sensor_bitfield, float32 eph, float32 epv, float32 evh, float32 evv, "
     "bool dead_reckoning, float32 vxy_max, float32 vz_max, float32 hagl_min, "
     "float32 hagl_max_z, float32 hagl_max_xy"},
    {"FailsafeFlags", 15, 15, 0,
     "uint64 timestamp, uint32 mode_req_angular_velocity, uint32 mode_req_attitude, "
     "uint32 mode_req_local_alt, uint32 mode_req_local_position, "
     "uint32 mode_req_local_position_relaxed, uint32 mode_req_global_position, "
     "uint32 mode_req_mission, uint32 mode_req_offboard_signal, "
     "uint32 mode_req_home_position, uint32 mode_req_wind_and_flight_time_compliance, "
     "uint32 mode_req_prevent_arming, uint32 mode_req_manual_control, uint32 mode_req_other, "
     "bool angular_velocity_invalid, bool attitude_invalid, bool local_altitude_invalid, "
     "bool local_position_invalid, bool local_position_invalid_relaxed, "
     "bool local_velocity_invalid, bool global_position_invalid, bool auto_mission_missing, "
     "bool offboard_control_signal_lost, bool home_position_invalid, "
     "bool manual_control_signal_lost, bool gcs_connection_lost, uint8 battery_warning, "
     "bool battery_low_remaining_time, bool battery_unhealthy, bool geofence_breached, "
     "bool mission_failure, bool vtol_fixed_wing_system_failure, bool wind_limit_exceeded, "
     "bool flight_time_limit_exceeded, bool local_position_accuracy_low, "
     "bool fd_critical_failure, bool fd_esc_arming_failure, bool fd_imbalanced_prop, "
     "bool fd_motor_failure"},
    {"FailsafeFlags", 16, 16, 0,
     "uint64 timestamp, uint32 mode_req_angular_velocity, uint32 mode_req_attitude, "
     "uint32 mode_req_local_alt, uint32 mode_req_local_position, "
     "uint32 mode_req_local_position_relaxed, uint32 mode_req_global_position, "
     "uint32 mode_req_mission, uint32 mode_req_offboard_signal, "
     "uint32 mode_req_home_position, uint32 mode_req_wind_and_flight_time_compliance, "
     "uint32 mode_req_prevent_arming, uint32 mode_req_manual_control, uint32 mode_req_other, "
     "bool angular_velocity_invalid, bool attitude_invalid, bool local_altitude_invalid, "
     "bool local_position_invalid, bool local_position_invalid_relaxed, "
     "bool local_velocity_invalid, bool global_position_invalid, bool auto_mission_missing, "
     "bool offboard_control_signal_lost, bool home_position_invalid, "
     "bool manual_control_signal_lost, bool gcs_connection_lost, uint8 battery_warning, "
     "bool battery_low_remaining_time, bool battery_unhealthy, bool geofence_breached, "
     "bool mission_failure, bool vtol_fixed_wing_system_failure, bool wind_limit_exceeded, "
     "bool flight_time_limit_exceeded, bool local_position_accuracy_low, "
     "bool navigator_failure, bool fd_critical_failure, bool fd_esc_arming_failure, "
     "bool fd_imbalanced_prop, bool fd_motor_failure"},
    {"FailsafeFlags", 17, 17, 0,
     "uint64 timestamp, uint32 mode_req_angular_velocity, uint32 mode_req_attitude, "
     "uint32 mode_req_local_alt, uint32 mode_req_local_position, "
     "uint32 mode_req_local_position_relaxed, uint32 mode_req_global_position, "
     "uint32 mode_req_global_position_relaxed, uint32 mode_req_mission, "
     "uint32 mode_req_offboard_signal, uint32 mode_req_home_position, "
     "uint32 mode_req_wind_and_flight_time_compliance, uint32 mode_req_prevent_arming, "
     "uint32 mode_req_manual_control, uint32 mode_req_other, bool angular_velocity_invalid, "
     "bool attitude_invalid, bool local_altitude_invalid, bool local_position_invalid, "
     "bool local_position_invalid_relaxed, bool local_velocity_invalid, "
     "bool global_position_invalid, bool global_position_invalid_relaxed, "
     "bool auto_mission_missing, bool offboard_control_signal_lost, "
     "bool home_position_invalid, bool manual_control_signal_lost, bool gcs_connection_lost, "
     "uint8 battery_warning, bool battery_low_remaining_time, bool battery_unhealthy, "
     "bool geofence_breached, bool mission_failure, bool vtol_fixed_wing_system_failure, "
     "bool wind_limit_exceeded, bool flight_time_limit_exceeded, bool position_accuracy_low, "
     "bool navigator_failure, bool fd_critical_failure, bool fd_esc_arming_failure, "
     "bool fd_imbalanced_prop, bool fd_motor_failure"},
    {"FailsafeFlags", 18, 18, 0,
     "uint64 timestamp, uint32 mode_req_angular_velocity, uint32 mode_req_attitude, "
     "uint32 mode_req_local_alt, uint32 mode_req_local_position, "
     "uint32 mode_req_local_position_relaxed, uint32 mode_req_global_position, "
     "uint32 mode_req_global_position_relaxed, uint32 mode_req_mission, "
     "uint32 mode_req_offboard_signal, uint32 mode_req_home_position, "
     "uint32 mode_req_wind_and_flight_time_compliance, uint32 mode_req_prevent_arming, "
     "uint32 mode_req_manual_control, uint32 mode_req_other, bool angular_velocity_invalid, "
     "bool attitude_invalid, bool local_altitude_invalid, bool local_position_invalid, "
     "bool local_position_invalid_relaxed, bool local_velocity_invalid, "
     "bool global_position_invalid, bool global_position_invalid_relaxed, "
     "bool auto_mission_missing, bool offboard_control_signal_lost, "
     "bool home_position_invalid, bool manual_control_signal_lost, bool gcs_connection_lost, "
     "uint8 battery_warning, bool battery_low_remaining_time, bool battery_unhealthy, "
     "bool fd_critical_failure, bool fd_esc_arming_failure, bool fd_imbalanced_prop, "
     "bool fd_motor_failure, bool fd_alt_loss, bool geofence_breached, bool mission_failure, "
     "bool vtol_fixed_wing_system_failure, bool wind_limit_exceeded, "
     "bool flight_time_limit_exceeded, bool position_accuracy_low, bool navigator_failure, "
     "bool parachute_unhealthy, bool remote_id_unhealthy, bool gnss_lost"},
    {"VehicleOdometry", 15, 18, 0,
     "uint64 timestamp, uint64 timestamp_sample, uint8 pose_frame, float32[3] position, "
     "float32[4] q, uint8 velocity_frame, float32[3] velocity, float32[3] angular_velocity, "
     "float32[3] position_variance, float32[3] orientation_variance, "
     "float32[3] velocity_variance, uint8 reset_counter, int8 quality"},
    {"VehicleControlMode", 15, 17, 0,
     "uint64 timestamp, bool flag_armed, bool flag_multicopter_position_control_enabled, "
     "bool flag_control_manual_enabled, bool flag_control_auto_enabled, "
     "bool flag_control_offboard_enabled, bool flag_control_position_enabled, "
     "bool flag_control_velocity_enabled, bool flag_control_altitude_enabled, "
     "bool flag_control_climb_rate_enabled, bool flag_control_acceleration_enabled, "
     "bool flag_control_attitude_enabled, bool flag_control_rates_enabled, "
     "bool flag_control_allocation_enabled, bool flag_control_termination_enabled, "
     "uint8 source_id"},
    {"VehicleControlMode", 18, 18, 0,
     "uint64 timestamp, bool flag_armed, bool flag_multicopter_position_control_enabled, "
     "bool flag_control_manual_enabled, bool flag_control_auto_enabled, "
     "bool flag_control_offboard_enabled, bool flag_control_position_enabled, "
     "bool flag_control_velocity_enabled, bool flag_control_altitude_enabled, "
     "bool flag_control_climb_rate_enabled, bool flag_control_attitude_enabled, "
     "bool flag_control_rates_enabled, bool flag_control_allocation_enabled"},
    {"VehicleCommand", 15, 18, 0,
     "uint64 timestamp, float32 param1, float32 param2, float32 param3, float32 param4, "
     "float64 param5, float64 param6, float32 param7, uint32 command, uint8 target_system, "
     "uint8 target_component, uint8 source_system, uint16 source_component, "
     "uint8 confirmation, bool from_external"},
    {"VehicleCommandAck", 15, 17, 0,
     "uint64 timestamp, uint32 command, uint8 result, uint8 result_param1, "
     "int32 result_param2, uint8 target_system, uint16 target_component, bool from_external"},
    {"VehicleCommandAck", 18, 18, 1,
     "uint64 timestamp, uint32 command, uint8 result, uint8 result_param1, "
     "int32 result_param2, uint8 target_system, uint16 target_component, bool from_external"},
    {"ManualControlSetpoint", 15, 18, 0,
     "uint64 timestamp, uint64 timestamp_sample, bool valid, uint8 data_source, float32 roll, "
     "float32 pitch, float32 yaw, float32 throttle, float32 flaps, float32 aux1, "
     "float32 aux2, float32 aux3, float32 aux4, float32 aux5, float32 aux6, "
     "bool sticks_moving, uint16 buttons"},
    {"OffboardControlMode", 15, 18, 0,
     "uint64 timestamp, bool position, bool velocity, bool acceleration, bool attitude, "
     "bool body_rate, bool thrust_and_torque, bool direct_actuator"},
    {"TrajectorySetpoint", 15, 18, 0,
     "uint64 timestamp, float32[3] position, float32[3] velocity, float32[3] acceleration, "
     "float32[3] jerk, float32 yaw, float32 yawspeed"},
    {"TimesyncStatus", 15, 18, 0,
     "uint64 timestamp, uint8 source_protocol, uint64 remote_timestamp, "
     "int64 observed_offset, int64 estimated_offset, uint32 round_trip_time"},
    {"HomePosition", 15, 16, 0,
     "uint64 timestamp, float64 lat, float64 lon, float32 alt, float32 x, float32 y, "
     "float32 z, float32 yaw, bool valid_alt, bool valid_hpos, bool valid_lpos, "
     "bool manual_home, uint32 update_count"},
    {"HomePosition", 17, 18, 1,
     "uint64 timestamp, float64 lat, float64 lon, float32 alt, float32 x, float32 y, "
     "float32 z, float32 roll, float32 pitch, float32 yaw, bool valid_alt, bool valid_hpos, "
     "bool valid_lpos, bool manual_home, uint32 update_count"},
    {"RegisterExtComponentRequest", 15, 17, 0,
     "uint64 timestamp, uint64 request_id, char[25] name, uint16 px4_ros2_api_version, "
     "bool register_arming_check, bool register_mode, bool register_mode_executor, "
     "bool enable_replace_internal_mode, uint8 replace_internal_mode, "
     "bool activate_mode_immediately"},
    {"RegisterExtComponentRequest", 18, 18, 2,
     "uint64 timestamp, uint64 request_id, char[25] name, uint16 px4_ros2_api_version, "
     "bool register_arming_check, bool register_mode, bool register_mode_executor, "
     "bool enable_replace_internal_mode, uint8 replace_internal_mode, "
     "bool activate_mode_immediately, bool not_user_selectable, "
     "bool request_offboard_setpoints"},
    {"RegisterExtComponentReply", 15, 17, 0,
     "uint64 timestamp, uint64 request_id, char[25] name, uint16 px4_ros2_api_version, "
     "bool success, int8 arming_check_id, int8 mode_id, int8 mode_executor_id"},
    {"RegisterExtComponentReply", 18, 18, 1,
     "uint64 timestamp, uint64 request_id, char[25] name, uint16 px4_ros2_api_version, "
     "bool success, int8 arming_check_id, int8 mode_id, int8 mode_executor_id, "
     "bool not_user_selectable"},
    {"UnregisterExtComponent", 15, 18, 0,
     "uint64 timestamp, char[25] name, int8 arming_check_id, int8 mode_id, "
     "int8 mode_executor_id"},
    {"ArmingCheckRequest", 15, 16, 0, "uint64 timestamp, uint8 request_id"},
    {"ArmingCheckRequest", 17, 18, 1,
     "uint64 timestamp, uint8 request_id, uint32 valid_registrations_mask"},
    {"ArmingCheckReply", 15, 16, 0,
     "uint64 timestamp, uint8 request_id, uint8 registration_id, "
     "uint8 health_component_index, bool health_component_is_present, "
     "bool health_component_warning, bool health_component_error, bool can_arm_and_run, "
     "uint8 num_events, Event[5] events, bool mode_req_angular_velocity, "
     "bool mode_req_attitude, bool mode_req_local_alt, bool mode_req_local_position, "
     "bool mode_req_local_position_relaxed, bool mode_req_global_position, "
     "bool mode_req_mission, bool mode_req_home_position, bool mode_req_prevent_arming, "
     "bool mode_req_manual_control"},
    {"ArmingCheckReply", 17, 18, 1,
     "uint64 timestamp, uint8 request_id, uint8 registration_id, "
     "uint8 health_component_index, bool health_component_is_present, "
     "bool health_component_warning, bool health_component_error, bool can_arm_and_run, "
     "uint8 num_events, Event[5] events, bool mode_req_angular_velocity, "
     "bool mode_req_attitude, bool mode_req_local_alt, bool mode_req_local_position, "
     "bool mode_req_local_position_relaxed, bool mode_req_global_position, "
     "bool mode_req_global_position_relaxed, bool mode_req_mission, "
     "bool mode_req_home_position, bool mode_req_prevent_arming, bool mode_req_manual_control"},
    {"Event", 15, 16, 0,
     "uint64 timestamp, uint32 id, uint16 event_sequence, uint8[25] arguments, "
     "uint8 log_levels"},
    {"Event", 17, 18, 1,
     "uint64 timestamp, uint32 id, uint16 event_sequence, uint8[25] arguments, "
     "uint8 log_levels"},
    {"ModeCompleted", 15, 18, 0, "uint64 timestamp, uint8 result, uint8 nav_state"},
});

int minor_of(std::string_view release) {
  int minor = 0;
  for (const char c : release.substr(release.find('.') + 1)) minor = 10 * minor + (c - '0');
  return minor;
}

// "VehicleStatus" → "vehicle_status".
std::string topic_of(std::string_view message) {
  std::string topic;
  for (const char c : message) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper && !topic.empty()) topic += '_';
    topic += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return topic;
}

template <class Matches>
const Definition* find(std::string_view release, Matches matches) {
  const int minor = minor_of(release);
  const auto it = std::find_if(kDefinitions.begin(), kDefinitions.end(), [&](const Definition& d) {
    return d.first <= minor && minor <= d.last && matches(d);
  });
  return it == kDefinitions.end() ? nullptr : &*it;
}

constexpr std::size_t kMostAligned = 8;

std::size_t bytes_of(std::string_view type) {
  for (const char* byte : {"uint8", "int8", "bool", "char"})
    if (type.starts_with(byte)) return 1;
  if (type.starts_with("Event")) return 40;  // the only message within others, alike in all
  if (type.find("16") != std::string_view::npos) return 2;
  return type.find("64") != std::string_view::npos ? 8 : 4;
}

std::size_t count_of(std::string_view type) {
  const auto bracket = type.find('[');
  if (bracket == std::string_view::npos) return 1;
  std::size_t count = 0;
  for (const char c : type.substr(bracket + 1, type.find(']') - bracket - 1))
    count = 10 * count + static_cast<std::size_t>(c - '0');
  return count;
}

}  // namespace

void check_px4_release(std::string_view release) {
  if (std::find(std::begin(kPx4Releases), std::end(kPx4Releases), release) !=
      std::end(kPx4Releases))
    return;
  throw std::invalid_argument("PX4 release '" + std::string(release) +
                              "': 1.15, 1.16, 1.17 or 1.18 expected");
}

int px4_version(std::string_view topic, std::string_view release) {
  const auto* definition =
      find(release, [&](const Definition& d) { return topic_of(d.message) == topic; });
  return definition ? definition->version : 0;
}

std::string_view px4_release_of(std::span<const std::string> wire_names,
                                std::string_view px4_namespace) {
  const std::string head =
      "rt/" + std::string(px4_namespace) + (px4_namespace.empty() ? "" : "/") + "fmu/out/";
  const auto is_there = [&](const char* topic, std::string_view release) {
    const int version = px4_version(topic, release);
    const auto name = head + topic + (version > 0 ? "_v" + std::to_string(version) : "");
    return std::find(wire_names.begin(), wire_names.end(), name) != wire_names.end();
  };
  for (auto release = std::rbegin(kPx4Releases); release != std::rend(kPx4Releases); ++release) {
    // 1.16 and 1.17 have the same status; their batteries and positions differ.
    const bool battery = is_there("battery_status", *release);
    const bool position = is_there("vehicle_local_position", *release);
    if (is_there("vehicle_status", *release) && (battery || position)) return *release;
  }
  return {};
}

Px4Layout px4_layout_of(std::string_view type, std::string_view release) {
  constexpr std::string_view kHead = "px4_msgs::msg::dds_::";
  if (!type.starts_with(kHead) || !type.ends_with('_')) return {};
  const auto message = type.substr(kHead.size(), type.size() - kHead.size() - 1);
  const auto* definition = find(release, [&](const Definition& d) { return d.message == message; });
  if (!definition) return {};
  Px4Layout layout;
  for (std::string_view rest = definition->fields; !rest.empty();) {
    const auto field = rest.substr(0, rest.find(", "));
    rest.remove_prefix(std::min(rest.size(), field.size() + 2));
    const auto space = field.find(' ');
    const auto type_name = field.substr(0, space);
    const std::size_t bytes = bytes_of(type_name);
    const std::size_t aligned = std::min(bytes, kMostAligned);
    layout.bytes = (layout.bytes + aligned - 1) / aligned * aligned;
    layout.fields.push_back({field.substr(space + 1), layout.bytes, bytes * count_of(type_name)});
    layout.bytes += layout.fields.back().bytes;
  }
  return layout;
}

void rearrange(const Px4Layout& from, std::span<const std::uint8_t> in, const Px4Layout& to,
               std::vector<std::uint8_t>& out) {
  out.assign(to.bytes, 0);
  for (const auto& field : to.fields) {
    const auto source =
        std::find_if(from.fields.begin(), from.fields.end(),
                     [&](const Px4Layout::Field& f) { return f.name == field.name; });
    if (source == from.fields.end() || source->bytes != field.bytes) continue;
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(source->at), field.bytes,
                out.begin() + static_cast<std::ptrdiff_t>(field.at));
  }
}

}  // namespace foretrack
