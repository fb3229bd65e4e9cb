"""Plot an episode of a data set that `handeye export lerobot` wrote, into episode.png.

pip install 'handeye[lerobot]' matplotlib
python plot_episode.py FOLDER [EPISODE]
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from lerobot.datasets.lerobot_dataset import LeRobotDataset

TELEVISION = "observation.images.television"

folder, number = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
data = LeRobotDataset(f"handeye/{folder.name}", root=folder, episodes=[number], video_backend="pyav")
frames = data.hf_dataset.remove_columns(data.meta.image_keys).with_format("numpy")[:]
times, positions, stages = frames["timestamp"], frames["observation.state"], frames["annotation.stage"]
names = [name.replace("_", " ") for name in data.features["observation.state"]["names"]]
force = np.linalg.norm(frames["observation.force"][:, :3], axis=1)
force[frames["observation.force_share"].ravel() == 0] = np.nan  # in these frames, it was not estimated
begins = [k for k, stage in enumerate(stages) if stage and (k == 0 or stage != stages[k - 1])]

figure, axes = plt.subplot_mosaic(
    [["joints", "picture"], ["joints", "stages"], ["gap", "stages"], ["force", "stages"]],
    figsize=(11, 7), width_ratios=[3, 1], height_ratios=[1.6, 0.4, 0.8, 0.8], layout="constrained",
)  # fmt: skip
figure.suptitle(f"episode {number}: {frames['annotation.outcome'][-1]}")
axes["joints"].plot(times, positions[:, :-1], linewidth=0.9, label=names[:-1])
axes["joints"].set_ylabel("joints, rad (boom: m)")
axes["joints"].legend(
    ncols=6, fontsize="small", loc="upper center", bbox_to_anchor=(0.5, -0.02), frameon=False
)
axes["gap"].plot(times, 1000 * positions[:, -1], "k", linewidth=0.9)
axes["gap"].set_ylabel("gap, mm")
axes["force"].plot(times, force, "k", linewidth=0.9)
axes["force"].set(ylabel="force, N", xlabel="time, s", ylim=(0, None))
for name in ("joints", "gap", "force"):
    axes[name].set_xlim(0, times[-1])
    axes[name].tick_params(labelbottom=name == "force")
    axes[name].vlines(times[begins], 0, 1, "0.6", "dotted", transform=axes[name].get_xaxis_transform())
for count, (k, end) in enumerate(zip(begins, [*begins[1:], -1], strict=True), 1):
    middle = (times[k] + times[end]) / 2
    axes["joints"].annotate(
        count, (middle, 1.01), xycoords=("data", "axes fraction"), ha="center", fontsize="small"
    )
axes["stages"].axis("off")
listed = "\n".join(f"{count}  {stages[k]}" for count, k in enumerate(begins, 1))
axes["stages"].text(0, 1, listed, va="top", linespacing=1.5)
axes["picture"].axis("off")
if TELEVISION in data.features:
    axes["picture"].imshow(data[len(data) - 1][TELEVISION].permute(1, 2, 0))
    age = frames["observation.picture_age"].ravel()[-1]
    axes["picture"].set_title(f"the last picture, at {times[-1] - age:.0f} s", fontsize="medium")
figure.savefig("episode.png", dpi=100)
