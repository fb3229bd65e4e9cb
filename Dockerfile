# Written, not yet built: where it was written no container could be run.
#
#   docker build -t handeye .
#   docker run --rm -it -v "$PWD:/work" handeye assemble        # the run is kept in ./runs
FROM python:3.12-slim
COPY . /handeye
RUN pip install --no-cache-dir /handeye
WORKDIR /work
ENTRYPOINT ["handeye"]
