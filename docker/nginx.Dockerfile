# nginx with throng's configuration; the same version that its test runs.
FROM docker.io/library/debian:bookworm-slim
RUN apt-get update && apt-get install -y --no-install-recommends nginx-light && rm -rf /var/lib/apt/lists/*
COPY docker/nginx.conf /etc/nginx/nginx.conf
EXPOSE 8080 8443
CMD ["nginx", "-g", "daemon off;"]
