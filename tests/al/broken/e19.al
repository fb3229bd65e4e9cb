        STAGE   "weigh the top in the hand"
        OPEN    2.8
        MOVE    TOP
        CENTER  2
        CLOSE   2 2.4
        LOAD    1020            ;as it says on the scales
        CHANGE  [0 0 1] 1
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 1.2
        LOAD    0
        OPEN    2.8
        PARK
