throng_bench(crowd SOURCES crowd.cpp LIBRARIES throng::crowd fmt::fmt TBB::tbb)
