throng_bench(sim SOURCES sim.cpp LIBRARIES throng::sim throng::crowd)
