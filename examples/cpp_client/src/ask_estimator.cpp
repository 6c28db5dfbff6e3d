// Asks an estimator for the bend angle of one pair of cable tensions, and waits no longer than 5 s.
//
// In the folder of tendon_statics, once that is built there and its install/setup.bash is sourced:
//
//   colcon build --base-paths examples/cpp_client && source install/setup.bash
//   ros2 run tendon_statics_cpp_client ask_estimator 1.0 2.0

#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "rclcpp/rclcpp.hpp"
#include "tendon_statics_interfaces/srv/solve.hpp"

using tendon_statics_interfaces::srv::Solve;

namespace
{

constexpr std::chrono::seconds kPatience{5};

double to_tension(const std::string & word)  // [N]
{
  std::istringstream rest(word);
  double tension = 0.0;
  if (!(rest >> tension) || !rest.eof()) {
    throw std::invalid_argument("'" + word + "' is no tension: give a number, in N");
  }
  return tension;
}

int ask(double tension_l, double tension_s)
{
  const auto node = std::make_shared<rclcpp::Node>("ask_estimator");
  const auto client = node->create_client<Solve>("estimator/solve");
  if (!client->wait_for_service(kPatience)) {
    if (rclcpp::ok()) {  // and no Ctrl-C
      RCLCPP_ERROR(node->get_logger(), "no estimator is running");
    }
    return 1;
  }

  auto request = std::make_shared<Solve::Request>();
  request->tension_l = tension_l;  // [N]
  request->tension_s = tension_s;  // [N]
  auto answer = client->async_send_request(request);
  const auto outcome = rclcpp::spin_until_future_complete(node, answer, kPatience);
  if (outcome != rclcpp::FutureReturnCode::SUCCESS) {
    client->remove_pending_request(answer);
    if (outcome == rclcpp::FutureReturnCode::TIMEOUT) {
      RCLCPP_ERROR(node->get_logger(), "no answer came in time");
    }
    return 1;
  }

  const auto response = answer.get();
  if (!response->success) {
    RCLCPP_ERROR(node->get_logger(), "%s", response->message.c_str());
    return 1;
  }
  if (std::isnan(response->bend_angle)) {  // friction holds the unit, or a cable is slack
    std::printf("%s: the tensions do not tell the angle\n", response->regime.c_str());
  } else {
    std::printf(
      "%s: %.4f +- %.4f rad, %.1f Pa\n", response->regime.c_str(), response->bend_angle,
      response->bend_angle_stddev, response->pressure);
  }
  return 0;
}

}  // namespace

int main(int argc, char ** argv)
{
  int code = 2;
  try {
    const auto arguments = rclcpp::init_and_remove_ros_arguments(argc, argv);
    if (arguments.size() == 3) {
      code = ask(to_tension(arguments[1]), to_tension(arguments[2]));
    } else {
      std::fprintf(stderr, "usage: ask_estimator TENSION_L TENSION_S, in N\n");
    }
  } catch (const std::exception & error) {
    std::fprintf(stderr, "ask_estimator: %s\n", error.what());
  }
  rclcpp::shutdown();
  return code;
}
