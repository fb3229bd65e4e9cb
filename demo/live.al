; The arm goes round above the table, feels for it at four places, and shuts and opens its hand.
; No pictures are taken, so nothing has to be calibrated: `handeye plan live.al -o live.plan.json`, then `handeye view`.
TRANS   NEAR_LEFT [20 32 3 90 90 0]
TRANS   NEAR_RIGHT [30 32 3 90 90 0]
TRANS   FAR_RIGHT [30 40 3 90 90 0]
TRANS   FAR_LEFT [20 40 3 90 90 0]
        STAGE   "shut the hand and open it"
        OPEN    2
        OPEN    .5
        OPEN    1
        STAGE   "feel for the table"
        MOVE    NEAR_LEFT
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 4 1
        MOVE    NEAR_LEFT
        MOVE    NEAR_RIGHT
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 4 1
        MOVE    NEAR_RIGHT
        MOVE    FAR_RIGHT
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 4 1
        MOVE    FAR_RIGHT
        MOVE    FAR_LEFT
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 4 1
        MOVE    FAR_LEFT
        STAGE   "open the hand"
        OPEN    2
