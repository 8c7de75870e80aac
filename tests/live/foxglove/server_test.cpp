// The server and real clients over the loopback: messages, slow clients, lost ones.
#include "live/foxglove/server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <cstring>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"

namespace throng::foxglove {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using nlohmann::json;

constexpr std::size_t kState = 0;
constexpr std::size_t kImages = 1;

/// A client whose calls block.
class TestClient {
 public:
  explicit TestClient(std::uint16_t port, const std::string& origin = "") {
    stream_.next_layer().connect({asio::ip::address_v4::loopback(), port});
    stream_.read_message_max(0);
    stream_.set_option(
        websocket::stream_base::decorator([origin](websocket::request_type& request) {
          request.set(beast::http::field::sec_websocket_protocol, "foxglove.websocket.v1");
          if (!origin.empty()) request.set(beast::http::field::origin, origin);
        }));
    stream_.handshake("127.0.0.1", "/");
    for (const char* op : {"serverInfo", "advertise", "advertiseServices"}) {
      EXPECT_EQ(json::parse(read()).at("op"), op);
    }
  }

  void send(const json& message) {
    stream_.text(true);
    stream_.write(asio::buffer(message.dump()));
  }
  void send_binary(const std::string& bytes) {
    stream_.binary(true);
    stream_.write(asio::buffer(bytes));
  }
  std::string read() {
    beast::flat_buffer buffer;
    stream_.read(buffer);
    return beast::buffers_to_string(buffer.data());
  }
  /// Subscribes under the channel's number, and waits until the server has read that.
  void subscribe(std::size_t channel) {
    send({{"op", "subscribe"}, {"subscriptions", {{{"id", channel}, {"channelId", channel}}}}});
    confirm();
  }
  /// Waits until the server has read all that was sent. No other message may be on its way.
  void confirm() {
    send({{"op", "getParameters"}, {"parameterNames", {"known"}}, {"id", "confirm"}});
    EXPECT_EQ(json::parse(read()).at("id"), "confirm");
  }
  /// Is gone without a word.
  void vanish() {
    stream_.next_layer().set_option(asio::socket_base::linger(true, 0));
    stream_.next_layer().close();
  }

 private:
  asio::io_context context_;
  websocket::stream<asio::ip::tcp::socket> stream_{context_};
};

struct Data {
  std::uint64_t time_ns = 0;
  std::string body;
};

Data read_data(TestClient& client) {
  constexpr std::size_t kHeadBytes = 13;
  const std::string frame = client.read();
  EXPECT_EQ(frame.at(0), 1);
  Data data;
  std::memcpy(&data.time_ns, &frame.at(5), sizeof(data.time_ns));
  data.body = frame.substr(kHeadBytes);
  return data;
}

/// A server of a state and of images, whose only service answers when the test says so.
class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    Hooks hooks;
    hooks.check_channel = [](const ClientChannel& channel) {
      if (channel.topic != "/go") throw InputError({channel.topic, "", "it", "/go"});
    };
    hooks.take_message = [this](const ClientChannel& channel, std::string_view bytes) {
      taken_.set_value(channel.topic + " " + std::string(bytes));
    };
    hooks.parameters = [this] {
      return std::vector<Parameter>{{"known", 1}, {"large", std::string(large_bytes_, 'x')}};
    };
    hooks.set_parameters = [](const std::vector<Parameter>&) {};
    hooks.call = [this](std::size_t, const json&, ServiceAnswer answer) {
      called_.set_value(std::move(answer));
    };
    ServerOptions options;
    options.port = 0;
    server_ = std::make_unique<Server>(
        options,
        std::vector<Channel>{{"/state", "State", "", false, true}, {"/images", "Image", "", true}},
        std::vector<Service>{{"/wait", "Wait", "{}", "{}"}}, std::move(hooks));
    server_->start();
  }

  /// Until nobody listens to the channel.
  void wait_until_unheard(std::size_t channel) const {
    while (server_->is_subscribed(channel)) std::this_thread::yield();
  }

  std::atomic<std::size_t> large_bytes_ = 1;
  std::promise<std::string> taken_;
  std::promise<ServiceAnswer> called_;
  std::unique_ptr<Server> server_;
};

TEST_F(ServerTest, SendsWhatAClientHasSubscribedTo) {
  server_->publish(kState, 5, "before");
  TestClient client(server_->port());
  server_->publish(kImages, 6, "for nobody");
  client.send({{"op", "subscribe"}, {"subscriptions", {{{"id", 0}, {"channelId", kState}}}}});
  EXPECT_EQ(read_data(client).body, "before") << "it is latched";
  client.subscribe(kImages);
  EXPECT_TRUE(server_->is_subscribed(kImages));
  server_->publish(kImages, 7, "an image");
  const Data data = read_data(client);
  EXPECT_EQ(data.time_ns, 7U);
  EXPECT_EQ(data.body, "an image");
  client.send({{"op", "unsubscribe"}, {"subscriptionIds", {kImages}}});
  client.confirm();
  EXPECT_FALSE(server_->is_subscribed(kImages));
}

TEST_F(ServerTest, HandsOnWhatClientsPublishAndRefusesTheRest) {
  TestClient client(server_->port());
  const auto channel = [](int id, const char* topic) {
    return json{{"id", id}, {"topic", topic}, {"encoding", "json"}, {"schemaName", ""}};
  };
  client.send({{"op", "advertise"}, {"channels", {channel(1, "/stop"), channel(2, "/go")}}});
  EXPECT_EQ(json::parse(client.read()).at("message"), "/stop: found it, expected /go");
  client.send_binary(std::string("\1\2\0\0\0now", 8));
  EXPECT_EQ(taken_.get_future().get(), "/go now");
  EXPECT_THROW(TestClient(server_->port(), "https://example.org"), beast::system_error);
}

TEST_F(ServerTest, ASlowClientLosesOldImagesAndGetsTheNewest) {
  constexpr std::uint64_t kCount = 40;
  constexpr std::size_t kBytes = 1 << 20;  // more together than connections hold
  TestClient slow(server_->port());
  slow.subscribe(kImages);
  for (std::uint64_t i = 1; i <= kCount; ++i) {
    server_->publish(kImages, i, std::string(kBytes, 'x'));
  }
  TestClient other(server_->port());
  other.confirm();  // the server has looked at all images by now
  std::uint64_t received = 0;
  for (std::uint64_t last = 0; last < kCount; ++received) {
    const Data image = read_data(slow);
    EXPECT_GT(image.time_ns, last);
    EXPECT_EQ(image.body.size(), kBytes);
    last = image.time_ns;
  }
  EXPECT_LT(received, kCount);
}

TEST_F(ServerTest, AClientThatAsksForMuchAndTakesNothingIsLeft) {
  large_bytes_ = 1 << 20;
  TestClient greedy(server_->port());
  greedy.subscribe(kImages);
  const json question = {{"op", "getParameters"}, {"parameterNames", {"large"}}, {"id", "more"}};
  EXPECT_THROW(
      {
        while (server_->is_subscribed(kImages)) greedy.send(question);
        while (true) greedy.read();
      },
      beast::system_error);
  TestClient other(server_->port());
  other.confirm();
}

TEST_F(ServerTest, OthersGoOnWhenAClientIsLost) {
  TestClient stays(server_->port());
  stays.subscribe(kState);
  TestClient lost(server_->port());
  lost.subscribe(kImages);
  lost.send_binary(std::string("\2\0\0\0\0\1\0\0\0\4\0\0\0json{}", 19));
  const ServiceAnswer answer = called_.get_future().get();
  lost.vanish();
  server_->publish(kImages, 1, std::string(1 << 20, 'x'));
  wait_until_unheard(kImages);
  answer("", {{"done", true}});  // to nobody
  server_->publish(kState, 2, "news");
  EXPECT_EQ(read_data(stays).body, "news");
}

TEST_F(ServerTest, AServiceMayAnswerLaterFromAnotherThread) {
  TestClient client(server_->port());
  client.send_binary(std::string("\2\0\0\0\0\7\0\0\0\4\0\0\0json{}", 19));
  ServiceAnswer answer = called_.get_future().get();
  std::thread([answer = std::move(answer)] { answer("", {{"done", true}}); }).join();
  const std::string response = client.read();
  EXPECT_EQ(response.substr(0, 9), std::string("\3\0\0\0\0\7\0\0\0", 9));
  EXPECT_TRUE(response.ends_with(R"({"done":true})"));
}

TEST_F(ServerTest, ItsEndIsTold) {
  TestClient client(server_->port());
  std::thread end([this] { server_.reset(); });
  EXPECT_THROW(client.read(), beast::system_error);
  end.join();
}

}  // namespace
}  // namespace throng::foxglove
