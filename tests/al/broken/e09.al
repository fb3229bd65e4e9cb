        TRANS   LEFT [22 35 4 90 90 0]
        TRANS   RIGHT [27 35 4 90 90 0]
DEFINE TAP
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.2
        CHANGE  Z 1
        OPEN    .5
        MOVE    LEFT
        TAP
        MOVE    RIGHT
        TAP
        PARK
