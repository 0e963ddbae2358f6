# twinform for CI without Python: docker build -t twinform . && docker run --rm -v "$PWD:/work" twinform check .
FROM python:3.13-slim AS build
COPY . /twinform
RUN pip wheel --no-cache-dir --no-deps --wheel-dir /dist /twinform

FROM python:3.13-slim
RUN --mount=type=bind,from=build,source=/dist,target=/dist \
    pip install --no-cache-dir --no-compile /dist/*.whl && useradd --uid 1000 twinform
USER 1000
WORKDIR /work
ENTRYPOINT ["twinform"]
CMD ["--help"]
