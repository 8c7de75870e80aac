throng_bench(server SOURCES server.cpp LIBRARIES throng::server spdlog::spdlog)
