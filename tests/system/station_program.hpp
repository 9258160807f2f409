// SPDX-License-Identifier: Apache-2.0
// A ground station under test, and the programs that read it as Foxglove does.
#pragma once

#include "tests/services/ground_station/raw_client.hpp"
#include "tests/system/program.hpp"

namespace foretrack {

inline const std::string kWeb = FORETRACK_SOURCE_DIR "/services/ground_station/web";

inline bool has_npm_packages() {
  return std::filesystem::exists(kWeb + "/node_modules/@foxglove/ws-protocol");
}

/// Runs one of the scripts of web/probe, which read as Foxglove does, and returns its report.
inline Json probe(const std::string& script, std::vector<std::string> arguments) {
  Folder folder;
  arguments.insert(arguments.begin(), {"node", kWeb + "/probe/" + script});
  Program node(arguments, folder.path / "out", "/usr/bin/env");
  EXPECT_EQ(node.wait(60.0), 0) << node.output();
  return Json::parse(node.output(), nullptr, false);
}

/// Arguments for /usr/bin/env: the program with its shipped files from this folder first.
inline std::vector<std::string> with_share(const std::filesystem::path& share,
                                           std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"FORETRACK_SHARE=" + share.string(), FORETRACK_PROGRAM});
  return arguments;
}

/// A station of its own tokens, log and recordings, on a free port.
class Station {
 public:
  Station(std::vector<std::string> arguments, const std::filesystem::path& folder, int port = 0,
          const std::filesystem::path& share = {})
      : folder_(folder),
        program_(with_share(share, with_files(std::move(arguments), port)), folder / "station.out",
                 "/usr/bin/env") {
    EXPECT_TRUE(
        eventually([&] { return program_.output().find("station: ") != std::string::npos; }, 20.0))
        << program_.output();
    const auto text = program_.output();
    const auto begin = text.find(':', text.find("://") + 3) + 1;
    port_ = static_cast<unsigned short>(std::stoi(text.substr(begin)));
    std::ifstream tokens(folder / "tokens");
    std::string name;
    tokens >> name >> token_;
  }

  std::string websocket() const { return "ws://127.0.0.1:" + std::to_string(port_) + "/ws"; }
  unsigned short port() const { return port_; }
  const std::string& token() const { return token_; }
  Program& program() { return program_; }
  std::string get(const std::string& path) {
    return ask(testing::request("GET " + path, port_, headers(token_)));
  }
  /// The answer to a POST with the token.
  Json post(const std::string& path, const Json& body, const std::string& token) {
    const auto text = ask(testing::request("POST " + path, port_, headers(token), body.dump()));
    return Json::parse(text, nullptr, false);
  }
  Json post(const std::string& path, const Json& body) { return post(path, body, token_); }
  Json status() { return Json::parse(get("/api/status"), nullptr, false); }
  Json vehicle() {
    const auto all = status();
    for (const auto& v : all["vehicles"])
      if (v["name"] == "uav1") return v;
    return nullptr;
  }

 private:
  static std::string headers(const std::string& token) {
    return "Connection: close\r\nAuthorization: Bearer " + token + "\r\n";
  }
  std::vector<std::string> with_files(std::vector<std::string> arguments, int port) const {
    for (const auto& [option, file] :
         {std::pair{"--token-file", "tokens"}, {"--audit-file", "audit"}})
      arguments.insert(arguments.end(), {option, (folder_ / file).string()});
    arguments.insert(arguments.end(), {"--port", std::to_string(port)});
    return arguments;
  }
  std::string ask(const std::string& bytes) {
    testing::RawClient client(port_);
    client.send(bytes);
    client.is_closed(10.0);
    const auto text = client.read_until("");
    const auto body = text.find("\r\n\r\n");
    return body == std::string::npos ? text : text.substr(body + 4);
  }

  std::filesystem::path folder_;
  Program program_;
  unsigned short port_ = 0;
  std::string token_;
};

}  // namespace foretrack
