throng_bench(annotate SOURCES annotate.cpp LIBRARIES throng::annotate)
