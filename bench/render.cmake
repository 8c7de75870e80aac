throng_bench(render
  SOURCES render.cpp ../tests/render/synthetic_people.cpp
  LIBRARIES throng::render throng::skinning)
