; set the spacer down on its mark and leave it there
        TRANS   SPACER [18 44 3 90 90 0]
        TRANS   MARK [25 38 4 90 90 0]
        TRANS   PARK [20 28 8 90 90 0]
        OPEN    1.5
        MOVE    SPACER
        CLOSE   .5
        LOAD    6
        MOVE    MARK
        CHANGE  [0 0 -1] 6      ;the last bit, straight down
        LOAD    0
        OPEN    1.5
        CHANGE  [0 0 1] 1
        PARK
