#include "common/analysis/metrics_json.h"

#include <nlohmann/json.hpp>

namespace ramify {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace

nlohmann::ordered_json metrics_json(const Metrics& metrics) {
  Json object = Json::object();
  for (const MetricInfo& info : metric_table()) {
    const std::optional<double> value = info.value(metrics);
    if (info.is_count && value) {
      object[std::string(info.key)] = static_cast<std::uint64_t>(*value);
    } else {
      object[std::string(info.key)] = number(value);
    }
  }
  object["by_order"] = Json::array();
  for (const OrderMetrics& own : metrics.by_order) {
    object["by_order"].push_back({{"order", own.order},
                                  {"axes", own.axes},
                                  {"length", own.length},
                                  {"volume", own.volume},
                                  {"angle_mean", number(own.angle_mean_deg)},
                                  {"angle_median", number(own.angle_median_deg)},
                                  {"tortuosity_mean", number(own.tortuosity_mean)}});
  }
  return object;
}

}  // namespace ramify
