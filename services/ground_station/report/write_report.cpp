// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/report/write_report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/evp.h>

#include <cmath>
#include <ctime>
#include <span>

#include "services/ground_station/report/map_sketch.hpp"

namespace foretrack::station {
namespace {

constexpr char kStyle[] = R"(
body{font:14px/1.45 system-ui,sans-serif;color:#14202b;max-width:980px;margin:24px auto;padding:0 16px}
h1{font-size:22px}h2{font-size:18px;margin-top:28px;border-bottom:1px solid #c9d3dc}h3{font-size:15px}
dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 16px}dt{color:#51626f}dd{margin:0}
table{border-collapse:collapse;width:100%;font-size:13px}td,th{padding:2px 10px 2px 0;text-align:left;
vertical-align:top;border-top:1px solid #e3e9ee}td:first-child,td:nth-child(2){white-space:nowrap}td:last-child{width:100%}
.bad{color:#a3320b;font-weight:600}.none{color:#51626f}.loss{display:flex;gap:14px;flex-wrap:wrap}
figure{margin:0}img{max-width:440px;width:100%;border:1px solid #c9d3dc}figcaption{font-size:12px}
.map{width:100%;border:1px solid #c9d3dc;background:#f7f9fb}.map text{font-size:12px;fill:#14202b}
.map polyline{fill:none;stroke-width:2}.map .vehicle{stroke:#1168a8}.map .person{stroke:#b36b00;
stroke-dasharray:5 3}.map .begin{fill:#1168a8}.map .end{fill:#fff;stroke:#1168a8;stroke-width:2}
.map .loss{fill:#a3320b}.map .ruler{stroke:#14202b;stroke-width:3}@media print{body{margin:0}}
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                                   static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

std::string utc(double time_s, const char* format) {
  const auto whole = static_cast<std::time_t>(time_s);
  std::tm parts{};
  gmtime_r(&whole, &parts);
  return fmt::format(fmt::runtime(format), parts);
}

std::string clock_time(double time_s) {
  return utc(time_s, "{:%H:%M:%S}") +
         fmt::format(".{}", static_cast<int>(10.0 * (time_s - std::floor(time_s))));
}

std::string span_text(double span_s) {
  const auto whole = static_cast<long>(std::lround(std::max(0.0, span_s)));
  return fmt::format("{}:{:02} min", whole / 60, whole % 60);
}

std::string row(std::string_view what, const std::string& value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, value);
}

std::string percent(std::optional<double> share) {
  return share ? fmt::format("{:.0f} %", 100.0 * *share) : "not known";
}

std::string spread_text(const Spread& values, const char* unit) {
  if (values.count == 0) return "<span class=\"none\">not known</span>";
  return fmt::format("{:.2f} {} at the mean, {:.2f} to {:.2f}", values.mean(), unit, values.least,
                     values.most);
}

std::string figure(const std::vector<std::uint8_t>& jpeg, const std::string& caption) {
  if (jpeg.empty())
    return fmt::format(
        "<figure><p class=\"none\">no picture was recorded</p><figcaption>{}"
        "</figcaption></figure>\n",
        caption);
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"/><figcaption>{0}"
      "</figcaption></figure>\n",
      caption, base64(jpeg));
}

std::string figures_of(const VehicleStory& v) {
  std::string html = "<dl>\n";
  html += row("flown", fmt::format("{:.0f} m", v.flown_m));
  html += row("armed", span_text(v.armed_s));
  html += row("following by a checked plan", span_text(v.tracked_s));
  html += row("the person was seen", span_text(v.seen_s));
  html += row("lost from sight",
              v.losses.size() == 1 ? "once" : fmt::format("{} times", v.losses.size()));
  html += row("distance to the person", spread_text(v.distance_m, "m"));
  html += row("speed", spread_text(v.speed_m_s, "m/s"));
  html += row("height in the map", spread_text(v.altitude_m, "m"));
  if (v.others_m.count > 0)
    html += row("nearest that anybody else came",
                fmt::format("{:.2f} m, middle to middle", v.others_m.least));
  if (v.battery_begin)
    html += row("battery", percent(v.battery_begin) + " to " + percent(v.battery_end));
  return html + "</dl>\n";
}

std::string loss_html(const StoryLoss& loss, std::size_t number) {
  const double out_s = loss.to_s.value_or(loss.from_s) - loss.from_s;
  std::string html = fmt::format(
      "<h3>Lost {}: {}, {}</h3>\n<div class=\"loss\">", number, clock_time(loss.from_s),
      loss.to_s ? fmt::format("for {:.1f} s", out_s) : "not seen again in this recording");
  html += figure(loss.picture, fmt::format("Lost {}: the last picture before", number));
  if (loss.to_s) html += figure(loss.found, fmt::format("Lost {}: seen again", number));
  return html + "</div>\n";
}

std::string events_html(const std::vector<StoryEvent>& events) {
  constexpr const char* kKinds[] = {"order", "gate", "mission", "alarm", "service", "person"};
  std::string html = "<table><tr><th>UTC</th><th>what</th><th></th></tr>\n";
  for (const auto& event : events)
    html += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        event.bad ? " class=\"bad\"" : "", clock_time(event.time_s),
                        kKinds[static_cast<int>(event.kind)], escaped(event.text));
  return html + "</table>\n";
}

std::string vehicle_html(const VehicleStory& v) {
  std::string html = fmt::format("<h2>{}</h2>\n", escaped(v.name));
  html += figures_of(v) + map_sketch(v);
  if (!v.losses.empty()) html += "<h2>Losses</h2>\n";
  for (std::size_t i = 0; i < v.losses.size(); ++i) html += loss_html(v.losses[i], i + 1);
  html += "<h2>Orders, modes and alarms</h2>\n";
  return html + (v.events.empty() ? "<p class=\"none\">none</p>\n" : events_html(v.events));
}

}  // namespace

std::string report_html(const FlightStory& story) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/><title>Flight of {}"
      "</title><style>{}</style></head><body>\n<h1>Flight of {}</h1>\n<dl>\n",
      utc(story.begin_s, "{:%Y-%m-%d %H:%M}"), kStyle, utc(story.begin_s, "{:%Y-%m-%d}"));
  html += row("recording", escaped(story.file));
  html += row("from, to", clock_time(story.begin_s) + " to " + clock_time(story.end_s) + " UTC, " +
                              span_text(story.end_s - story.begin_s));
  if (!story.version.empty())
    html += row("recorded by", escaped("foretrack " + story.version +
                                       (story.host.empty() ? "" : " on " + story.host)));
  if (!story.fault.empty())
    html += row("<span class=\"bad\">incomplete</span>", escaped(story.fault));
  html += "</dl>\n";
  for (const auto& vehicle : story.vehicles) html += vehicle_html(vehicle);
  if (story.vehicles.empty()) html += "<p class=\"none\">No vehicle is in this recording.</p>\n";
  return html + "</body></html>\n";
}

}  // namespace foretrack::station
