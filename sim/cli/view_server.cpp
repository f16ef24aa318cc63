#include "sim/cli/view_server.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace hedgehop::sim::cli {
namespace {

constexpr size_t kMaxRequestBytes = 16'384;
constexpr auto kFarewell = std::chrono::seconds(2);

std::string event_text(const std::string& name, const std::string& data) {
  return fmt::format("event: {}\ndata: {}\n\n", name, data);
}

std::string response(const std::string& status, const std::string& type, const std::string& body) {
  return fmt::format(
      "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n{}",
      status, type, body.size(), body);
}

/// Returns whether the request names the loopback interface. Other names are those of pages of other sites, which must
/// not read or control the flight.
bool is_local(const std::string& request) {
  std::string lower(request.size(), ' ');
  std::ranges::transform(request, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  const auto names_loopback = [&](const std::string& header, const std::string& scheme, bool required) {
    const size_t at = lower.find("\r\n" + header + ": ");
    if (at == std::string::npos) return !required;
    const size_t begin = at + header.size() + 4;
    const std::string value = lower.substr(begin, lower.find("\r\n", begin) - begin);
    return value.starts_with(scheme + "127.0.0.1:") || value.starts_with(scheme + "localhost:");
  };
  return names_loopback("host", "", true) && names_loopback("origin", "http://", false);
}

}  // namespace

ViewServer::ViewServer(std::string page) : page_(std::move(page)) {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  wake_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* const general = reinterpret_cast<sockaddr*>(&address);
  if (listener_ < 0 || wake_ < 0 || ::bind(listener_, general, size) != 0 || ::listen(listener_, 8) != 0 ||
      ::getsockname(listener_, general, &size) != 0) {
    throw std::runtime_error(
        fmt::format("--view: no server on 127.0.0.1: {}", std::error_code(errno, std::generic_category()).message()));
  }
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { serve(); });
}

ViewServer::~ViewServer() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake();
  thread_.join();
  for (const Client& client : clients_) ::close(client.socket);
  ::close(listener_);
  ::close(wake_);
}

std::string ViewServer::url() const { return fmt::format("http://127.0.0.1:{}/", port_); }

bool ViewServer::wait_for_viewer(double limit_s) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::duration<double>(limit_s), [&] { return viewers_ > 0; });
}

bool ViewServer::has_viewer() {
  const std::lock_guard lock(mutex_);
  return viewers_ > 0;
}

bool ViewServer::is_paused() {
  const std::lock_guard lock(mutex_);
  return paused_;
}

void ViewServer::send(const std::string& name, const std::string& data_json) {
  {
    const std::lock_guard lock(mutex_);
    events_.push_back(event_text(name, data_json));
  }
  wake();
}

void ViewServer::send_latest(const std::string& name, const std::string& data_json) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = event_text(name, data_json);
    ++latest_number_;
  }
  wake();
}

void ViewServer::wait_while_paused() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !paused_ || steps_ > 0 || viewers_ == 0; });
  if (paused_ && steps_ > 0) --steps_;
}

void ViewServer::order(const std::string& word) {
  const std::lock_guard lock(mutex_);
  if (word == "step") {
    ++steps_;
  } else {
    steps_ = 0;
  }
  const bool paused = word != "play";
  if (paused != paused_) events_.push_back(event_text("paused", paused ? "true" : "false"));
  paused_ = paused;
  changed_.notify_all();
}

void ViewServer::wake() const {
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_, &one, sizeof(one));
}

void ViewServer::answer(Client& client) {
  const std::string first = client.input.substr(0, client.input.find("\r\n"));
  client.closes = true;
  if (!is_local(client.input)) {
    client.output = response("403 Forbidden", "text/plain", "only for browsers of this machine\n");
  } else if (first.starts_with("GET / ")) {
    client.output = response("200 OK", "text/html; charset=utf-8", page_);
  } else if (first.starts_with("GET /events ")) {
    client.output = "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\n\r\n";
    client.streams = true;
    client.closes = false;
    const std::lock_guard lock(mutex_);
    ++viewers_;
    changed_.notify_all();
  } else if (first.starts_with("POST /pause ") || first.starts_with("POST /play ") ||
             first.starts_with("POST /step ")) {
    order(first.substr(6, first.find(' ', 6) - 6));
    client.output = response("204 No Content", "text/plain", "");
  } else {
    client.output = response("404 Not Found", "text/plain", "only the live view is here\n");
  }
}

void ViewServer::read_from(Client& client) {
  char bytes[4096];
  while (true) {
    const ssize_t count = ::recv(client.socket, bytes, sizeof(bytes), 0);
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    if (count <= 0) {
      client.closes = true;
      client.output.clear();
      return;
    }
    if (!client.streams) client.input.append(bytes, static_cast<size_t>(count));
  }
  const bool is_new = client.output.empty() && !client.streams;
  if (is_new && client.input.find("\r\n\r\n") != std::string::npos) answer(client);
  if (client.input.size() > kMaxRequestBytes) client.closes = true;
}

void ViewServer::feed(Client& client) {
  for (; client.sent_events < events_.size(); ++client.sent_events) client.output += events_[client.sent_events];
  if (client.sent_latest != latest_number_) client.output += latest_;
  client.sent_latest = latest_number_;
}

bool ViewServer::all_sent() const {
  return std::ranges::all_of(clients_, [](const Client& client) { return client.output.empty(); });
}

void ViewServer::serve() {
  std::chrono::steady_clock::time_point ended;
  while (true) {
    bool ends = false;
    {
      const std::lock_guard lock(mutex_);
      ends = ends_;
      for (Client& client : clients_) {
        if (client.streams && client.output.empty()) feed(client);
      }
    }
    const auto now = std::chrono::steady_clock::now();
    if (ends && ended == std::chrono::steady_clock::time_point()) ended = now;
    if (ends && (all_sent() || now > ended + kFarewell)) return;

    std::vector<pollfd> waiting{{listener_, POLLIN, 0}, {wake_, POLLIN, 0}};
    for (const Client& client : clients_) {
      const short events = client.output.empty() ? POLLIN : POLLIN | POLLOUT;
      waiting.push_back({client.socket, events, 0});
    }
    ::poll(waiting.data(), waiting.size(), 200);
    uint64_t ignored = 0;
    [[maybe_unused]] const ssize_t count = ::read(wake_, &ignored, sizeof(ignored));
    for (size_t i = 0; i < clients_.size(); ++i) {
      Client& client = clients_[i];
      const short happened = waiting[i + 2].revents;
      if (happened & (POLLIN | POLLHUP | POLLERR)) read_from(client);
      if (client.output.empty()) continue;
      const ssize_t sent =
          ::send(client.socket, client.output.data(), client.output.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent > 0) client.output.erase(0, static_cast<size_t>(sent));
      if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK) {
        client.closes = true;
        client.output.clear();
      }
    }
    std::erase_if(clients_, [&](const Client& client) {
      if (!client.closes || !client.output.empty()) return false;
      ::close(client.socket);
      const std::lock_guard lock(mutex_);
      viewers_ -= client.streams ? 1 : 0;
      changed_.notify_all();
      return true;
    });
    for (int socket; (socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK)) >= 0;) {
      clients_.push_back({.socket = socket});
    }
  }
}

}  // namespace hedgehop::sim::cli
